// SPDX-License-Identifier: BSD-3-Clause
//
// What the front end makes of one scan: a line of CSV for each valid point, with its ring, ground
// or cluster, and the feature sets that it is in (the paper's figure 9).
//
//   feature_stages SCAN [SENSOR [METHOD]] > stages.csv

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "features/features.hpp"
#include "io/error.hpp"
#include "io/recognise_sensor.hpp"
#include "io/scan_source.hpp"
#include "io/sensor_yaml.hpp"
#include "io/settings_yaml.hpp"
#include "segmentation/ground.hpp"
#include "segmentation/range_image.hpp"
#include "segmentation/segmentation.hpp"

namespace {

using namespace lego_loam_sc;

// Which points of the image are in a feature set: those at the same place in the same row.
std::vector<std::uint8_t> marked(const std::vector<FeaturePoint>& features,
                                 const RangeImage& image) {
  std::vector<std::uint8_t> mark(image.size(), 0);
  for (const FeaturePoint& feature : features) {
    const auto begin = image.points.begin() + image.row_begin[feature.row];
    const auto end = image.points.begin() + image.row_begin[feature.row + 1];
    const auto point = std::find(begin, end, feature.position);
    if (point != end) mark[point - image.points.begin()] = 1;
  }
  return mark;
}

void print_stages(const std::string& path, const std::optional<std::string>& sensor_name,
                  const std::string& method) {
  const std::unique_ptr<ScanSource> source = open_scans(path);
  const std::optional<Scan> scan = source->next();
  if (!scan) throw InputError(path + ": there is no scan in it, give one scan");
  const SensorModel sensor = sensor_name ? with_facts(load_sensor(*sensor_name), source->facts())
                                         : recognise_sensor(*scan, source->facts());
  const Settings settings = load_settings(method, std::nullopt, {});

  const RangeImage image = project(*scan, sensor);
  double height = sensor.height;
  if (height == 0.0)
    height = estimate_sensor_height(image, sensor, settings.segmentation).value_or(0.0);
  const Segmentation segmentation = segment(image, sensor, height, settings.segmentation);
  const Features features = extract_features(image, segmentation, sensor, settings.features);

  const auto edge_large = marked(features.edges_large, image);
  const auto edge_sharp = marked(features.edges_sharp, image);
  const auto planar_large = marked(features.planars_large, image);
  const auto planar_flat = marked(features.planars_flat, image);
  std::puts("x,y,z,ring,ground,cluster,edge_large,edge_sharp,planar_large,planar_flat");
  for (int ring = 0; ring < image.rows; ++ring)
    for (std::size_t i = image.row_begin[ring]; i < image.row_begin[ring + 1]; ++i)
      std::printf("%.4f,%.4f,%.4f,%d,%d,%d,%d,%d,%d,%d\n", image.points[i].x(),
                  image.points[i].y(), image.points[i].z(), ring,
                  segmentation.label[i] == Label::ground, segmentation.cluster[i], edge_large[i],
                  edge_sharp[i], planar_large[i], planar_flat[i]);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 4) {
    std::fputs("usage: feature_stages SCAN [SENSOR [METHOD]] > stages.csv\n", stderr);
    return 2;
  }
  try {
    print_stages(argv[1], argc > 2 ? std::optional<std::string>(argv[2]) : std::nullopt,
                 argc > 3 ? argv[3] : "lego-loam-sc");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
