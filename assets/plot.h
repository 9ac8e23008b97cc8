// Curves over axes, as a drawing.
#pragma once

#include <string>

#include "mesh/flat_drawing.h"

namespace brisance::assets {

/// What an axis shows, and its numbers; logarithmic where asked for, all of it positive then.
struct PlotAxis {
  std::string title;
  double from = 0, to = 1;
  std::vector<double> ticks;
  bool logarithmic = false;
};

class Plot {
 public:
  Plot(const PlotAxis& x, const PlotAxis& y);
  void curve(std::span<const Vec2d> points, const Stroke& stroke);
  void dots(std::span<const Vec2d> points, const std::string& colour);
  /// A line of the key, in the order they come, from the plot's upper edge down; `left` edge of 0 .. 1 of the width.
  void name(const std::string& words, const Stroke& stroke, double left);
  void nameDots(const std::string& words, const std::string& colour, double left);
  const FlatDrawing& drawing() const { return drawing_; }

 private:
  Vec2d at(const Vec2d& value) const;
  std::vector<Vec2d> at(std::span<const Vec2d> values) const;
  double nextLine();

  PlotAxis x_, y_;
  FlatDrawing drawing_;
  int named_ = 0;
};

}  // namespace brisance::assets
