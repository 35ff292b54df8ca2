// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lego_loam_sc {

/// A correction that is applied only while it proves itself. Each measurement is of the whole
/// error, whatever has been applied by then. Measurements are averaged in blocks; the mean of the
/// blocks so far is tried on each block that follows, which did not serve to find it: it gains what
/// it lowers the square of that block by. It is applied when the mean gain exceeds its own
/// uncertainty threefold and the correction exceeds what the measurements may be off by in common,
/// and taken back when later blocks have used up that proof.
class ProvenCorrection {
 public:
  /// `floor`: a smaller correction is never applied.
  explicit ProvenCorrection(double floor) : floor_(floor) {}

  /// The next measurement.
  void add(double measurement);

  /// The correction in force; 0 when none has proved itself.
  double value() const { return value_; }
  /// One sigma of the mean of all blocks; 0 before the second.
  double sigma() const;

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(value_, block_sum_, in_block_, sums_.n, sums_.sum, sums_.square, gains_.n, gains_.sum,
            gains_.square);
  }

 private:
  struct Sums {
    double n = 0.0;
    double sum = 0.0;
    double square = 0.0;

    void add(double x);
    double mean() const { return sum / n; }
    double sigma_of_mean() const;
  };

  void add_block(double mean);

  double floor_;
  double value_ = 0.0;
  double block_sum_ = 0.0;
  int in_block_ = 0;
  Sums sums_;   // of the means of the blocks
  Sums gains_;  // of what the mean before each block gained on it
};

}  // namespace lego_loam_sc
