// Values as they are typed: ranges of frames, sizes of pictures.
#include <charconv>

#include "base/check.h"
#include "options.h"

namespace brisance {

namespace {

/// A whole number from 1 at the start of `text`, taken off it.
std::optional<int> takeNumber(std::string_view& text) {
  int value = 0;
  const auto [end, trouble] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (trouble != std::errc() || value < 1) return std::nullopt;
  text.remove_prefix(end - text.data());
  return value;
}

bool take(std::string_view& text, char letter) {
  if (!text.starts_with(letter)) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

FrameRange parseFrameRange(const std::string& text) {
  std::string_view rest = text;
  const auto first = takeNumber(rest);
  const auto last = take(rest, '-') ? takeNumber(rest) : first;
  const auto step = take(rest, ':') ? takeNumber(rest) : std::optional<int>(1);
  if (!first || !last || !step || !rest.empty() || *last < *first)
    throw InputError(fmt::format(
        "brisance: --frames: must be A-B or A-B:S with 1 <= A <= B and S >= 1, like 1-100:2, got {}", text));
  return {*first, *last, *step};
}

PictureSize parsePictureSize(const std::string& text) {
  std::string_view rest = text;
  const auto width = takeNumber(rest);
  const auto height = take(rest, 'x') ? takeNumber(rest) : std::nullopt;
  if (!width || !height || !rest.empty())
    throw InputError(fmt::format("brisance: --size: must be WIDTHxHEIGHT in pixels, like 640x480, got {}", text));
  return {*width, *height};
}

}  // namespace brisance
