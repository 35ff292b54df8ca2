// SPDX-License-Identifier: BSD-3-Clause
#include "slam/slam.hpp"

#include <stdexcept>
#include <utility>

namespace lego_loam_sc {
namespace {

const SensorModel& checked(const SensorModel& sensor, const Settings& settings) {
  if (const auto fault = validate(sensor)) throw std::invalid_argument(*fault);
  if (const auto fault = validate(settings)) throw std::invalid_argument(*fault);
  return sensor;
}

}  // namespace

Slam::Slam(const SensorModel& sensor, const Settings& settings, int threads, LoopDetector detector,
           std::shared_ptr<BlobStore> points)
    : range_noise_(checked(sensor, settings).range_noise),
      back_end_settings_(settings),
      detector_(std::move(detector)),
      threads_(threads),
      key_frames_(std::make_shared<KeyFrames>(std::move(points))),
      tracker_(sensor, settings, key_frames_),
      back_end_(new_back_end()) {}

BackEnd Slam::new_back_end() const {
  return BackEnd(back_end_settings_, range_noise_, detector_, key_frames_);
}

// Paper figure 4.
ScanReport Slam::process(const Scan& scan) {
  return threads_.run([&] {
    TrackedScan tracked = tracker_.track(scan);  // 2.3 (1) to (4)
    if (tracked.first_again) replace_first(*tracked.first_again);
    BackEnd::Result found;
    if (tracked.key_frame) {
      StageTimer timer(tracked.milliseconds);
      timer.start(Stage::loops);
      found = back_end_.add(*tracked.key_frame);  // 2.3 (5), (6)
      if (found.correction) tracker_.correct(*found.correction);
    }
    fusion_.add(tracked);
    return report_of(tracked, std::move(found.loops));
  });
}

// The second scan of a drive that began at speed has changed what became of the first.
void Slam::replace_first(const TrackedScan& first) {
  back_end_ = new_back_end();
  back_end_.add(*first.key_frame);
  fusion_ = {};
  fusion_.add(first);
}

bool Slam::write(StateWriter& writer) const {
  if (tracker_.may_reprocess()) return false;
  writer(tracker_, back_end_, fusion_);
  return true;
}

void Slam::read(StateReader& reader) {
  threads_.run([&] {
    reader(tracker_, back_end_, fusion_);
    return true;
  });
}

}  // namespace lego_loam_sc
