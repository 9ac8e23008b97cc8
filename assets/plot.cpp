#include "assets/plot.h"

#include <fmt/format.h>

#include <cmath>

namespace brisance::assets {
namespace {
constexpr double pictureWidth = 560;  // [px]
constexpr double height = 0.72;       // of the frame, whose width is 1
constexpr double textSize = 13, tickLength = 0.012;
const Stroke frameStroke{"#1d232b", 1.2}, gridStroke{"#d7dce2", 0.7};

double share(const PlotAxis& axis, double value) {
  if (axis.logarithmic) return std::log(value / axis.from) / std::log(axis.to / axis.from);
  return (value - axis.from) / (axis.to - axis.from);
}

/// The frame, and room for numbers and titles.
Box3 canvas() {
  Box3 box;
  box.include({-0.13, -0.13, 0});
  box.include({1.03, height + 0.07, 0});
  return box;
}
}  // namespace

Plot::Plot(const PlotAxis& x, const PlotAxis& y) : x_(x), y_(y), drawing_(canvas(), pictureWidth) {
  for (const double tick : x.ticks) {
    const double place = share(x, tick);
    drawing_.polyline(std::vector<Vec2d>{{place, 0}, {place, height}}, gridStroke);
    drawing_.text({place, -0.04}, fmt::format("{:g}", tick), textSize);
  }
  for (const double tick : y.ticks) {
    const double place = share(y, tick) * height;
    drawing_.polyline(std::vector<Vec2d>{{0, place}, {1, place}}, gridStroke);
    drawing_.text({-0.06, place}, fmt::format("{:g}", tick), textSize);
  }
  drawing_.polygon(std::vector<Vec2d>{{0, 0}, {1, 0}, {1, height}, {0, height}}, "", frameStroke);
  drawing_.text({0.5, -0.1}, x.title, textSize);
  drawing_.text({0.06, height + 0.035}, y.title, textSize);
}

Vec2d Plot::at(const Vec2d& value) const { return {share(x_, value.x), share(y_, value.y) * height}; }
std::vector<Vec2d> Plot::at(std::span<const Vec2d> values) const {
  std::vector<Vec2d> places;
  for (const Vec2d& value : values) places.push_back(at(value));
  return places;
}

void Plot::curve(std::span<const Vec2d> points, const Stroke& stroke) { drawing_.polyline(at(points), stroke); }
void Plot::dots(std::span<const Vec2d> points, const std::string& colour) { drawing_.dots(at(points), 3.2, colour); }

double Plot::nextLine() { return height - 0.045 - 0.042 * named_++; }

void Plot::name(const std::string& words, const Stroke& stroke, double left) {
  const double y = nextLine();
  drawing_.polyline(std::vector<Vec2d>{{left, y}, {left + 0.07, y}}, stroke);
  drawing_.text({left + 0.2, y}, words, textSize);
}
void Plot::nameDots(const std::string& words, const std::string& colour, double left) {
  const double y = nextLine();
  drawing_.dots(std::vector<Vec2d>{{left + 0.035, y}}, 3.2, colour);
  drawing_.text({left + 0.2, y}, words, textSize);
}

}  // namespace brisance::assets
