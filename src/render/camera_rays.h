// The rays of a picture: which ways each pixel looks along, and how much each counts.
#pragma once

#include <vector>

#include "base/random.h"
#include "render/camera.h"
#include "render/sample_sequence.h"
#include "render/scene_geometry.h"

namespace brisance {

/// When a picture is taken. The shutter opens half of its time before `filmTime` and closes half after.
struct PictureTime {
  double filmTime = 0;              ///< [s] of film: where the camera's keys are
  double frameDuration = 1.0 / 24;  ///< [s] of film per frame
  double simulatedPerFilm = 1;  ///< simulated seconds per second of film: how far bodies move while the shutter is open
};

/// One sample of a pixel.
struct CameraRay {
  Ray ray;
  float phase;             ///< 0 .. 1: shifts the samples taken in the gas
  SampleSequence numbers;  ///< for what the ray meets
};

/// Jittered samples, one in each of n x n sub-pixels (appendix A.1.3), addressed by frame, pixel and sample. Where the
/// settings' n is not whole, the next larger one.
class CameraRays {
 public:
  CameraRays(const RenderSettings& settings, const PictureTime& time, int frame);
  int perPixel() const { return static_cast<int>(weights_.size()); }
  /// How much sample s counts in its pixel; all together 1.
  float weight(int s) const { return weights_[s]; }
  /// The colour of its sub-pixel on a checkerboard: 0 or 1.
  int field(int s) const { return (s / samples_ + s % samples_) % 2; }
  /// Sample s of pixel (x, y).
  CameraRay ray(int x, int y, int s) const;
  /// The same where pixels may have as many samples as they like, each counting as much as another: any number of first
  /// ones lies evenly over the pixel.
  CameraRay freeRay(int x, int y, int s) const;
  const Random& allotment() const { return allotment_; }  ///< chance by which those samples are shared out

 private:
  std::uint64_t numberOf(int x, int y) const { return firstPixel_ + static_cast<std::uint64_t>(y) * width_ + x; }
  SampleSequence numbersOf(std::uint64_t pixel, int s) const;
  CameraRay through(const Vec2<double>& place, std::uint64_t pixel, int s, float phase, SampleSequence numbers) const;

  int samples_;
  std::vector<float> weights_;
  std::vector<Camera> cameras_;  ///< at as many times of the open shutter
  Random jitter_, allotment_;
  std::uint64_t firstPixel_;
  int width_;
};

}  // namespace brisance
