// Pictures as arrays.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"
#include "base/check.h"
#include "base/durable_file.h"
#include "bindings.h"
#include "interruption.h"
#include "render/picture_file.h"

namespace brisance::python {
namespace {

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Bytes = py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>;

/// The scene with a picture's measures, checked as --set checks them.
Scene sceneWith(const SceneHandle& scene, const PictureWish& wish) {
  std::vector<std::string> overrides;
  const auto say = [&](const char* key, const auto& value) {
    if (value) overrides.push_back(fmt::format("render.{}={}", key, *value));
  };
  say("width", wish.width);
  say("height", wish.height);
  say("samples", wish.samples);
  Scene wished = overrides.empty() ? scene.scene() : scene.with(overrides)->scene();
  wished.render.writeExr = wished.render.layers = wish.alpha;
  return wished;
}

DrawnPicture draw(const SceneHandle& handle, const Scene& scene, const Frame& frame) {
  const double fps = scene.film.fps;
  const PictureTime time{(frame.index - 1) / fps, 1 / fps, scene.film.timeScale};
  return interruptibly([&] {
    RenderScratch scratch;
    return drawFilmFrame(frame, scene.render, *handle.assets(), time, scratch, isCancelled);
  });
}

py::array withAlpha(const Image& light, const std::vector<float>& alpha) {
  std::vector<float> numbers;
  numbers.reserve(4 * alpha.size());
  for (std::size_t n = 0; n < alpha.size(); ++n) {
    const Vec3f& pixel = light.pixels[n];
    numbers.insert(numbers.end(), {pixel.x, pixel.y, pixel.z, alpha[n]});
  }
  return arrayOf(std::move(numbers), {light.height, light.width, 4});
}

template <class Array>
void requirePicture(const Array& array, int most) {
  if (array.ndim() == 3 && array.shape(2) >= 3 && array.shape(2) <= most && array.size() > 0) return;
  throw InputError(fmt::format("picture: must be an array of shape (height, width, 3{})", most > 3 ? " or 4" : ""));
}

Image imageOf(const Floats& array) {
  requirePicture(array, 4);
  const auto in = array.unchecked<3>();
  Image image(static_cast<int>(in.shape(1)), static_cast<int>(in.shape(0)));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) image(x, y) = {in(y, x, 0), in(y, x, 1), in(y, x, 2)};
  return image;
}

Picture pictureOfBytes(const Bytes& array) {
  requirePicture(array, 3);
  return {static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)),
          std::vector<std::uint8_t>(array.data(), array.data() + array.size())};
}

py::array developedArray(const Floats& array, double exposureStops) {
  Picture picture = developed(imageOf(array), exposureStops);
  return arrayOf(std::move(picture.rgb), {picture.height, picture.width, 3});
}

bool holdsBytes(const py::array& picture) { return picture.dtype().kind() == 'u' && picture.itemsize() == 1; }

std::string fileOf(const std::filesystem::path& path, const py::array& picture, double exposureStops) {
  if (path.extension() == ".exr") return encodeExr(imageOf(Floats::ensure(picture)));
  if (path.extension() != ".png") throw InputError(fmt::format("{}: must end in .png or .exr", path.string()));
  if (holdsBytes(picture)) return encodePng(pictureOfBytes(Bytes::ensure(picture)));
  return encodePng(developed(imageOf(Floats::ensure(picture)), exposureStops));
}

void save(const std::filesystem::path& path, const py::array& picture, double exposureStops) {
  writeDurably(path, fileOf(path, picture, exposureStops));
}

py::array render(const std::shared_ptr<SceneHandle>& scene, const std::shared_ptr<Frame>& frame,
                 std::optional<int> width, std::optional<int> height, std::optional<double> samples, bool alpha) {
  return pictureOf(*scene, *frame, {width, height, samples, alpha});
}

}  // namespace

py::array pictureOf(const SceneHandle& scene, const Frame& frame, const PictureWish& wish) {
  const Scene wished = sceneWith(scene, wish);
  DrawnPicture drawn = draw(scene, wished, frame);
  if (wish.alpha) return withAlpha(drawn.light, drawn.layers.alpha);
  return arrayOf(std::move(drawn.light.pixels), {drawn.light.height, drawn.light.width, 3});
}

void bindPictures(py::module_& module) {
  module.def(
      "render", &render, py::arg("scene"), py::arg("frame"), py::kw_only(), py::arg("width") = py::none(),
      py::arg("height") = py::none(), py::arg("samples") = py::none(), py::arg("alpha") = false,
      "The picture of a Frame: float32 (height, width, 3), scene-linear light with the primaries of sRGB, from the\n"
      "top left; with `alpha` (height, width, 4), the share that is not sky. As `brisance render` draws it.");
  module.def("develop", &developedArray, py::arg("picture"), py::arg("exposure_stops") = 0.0,
             "What a screen shows of a picture: uint8 (height, width, 3), sRGB.");
  module.def("save", &save, py::arg("path"), py::arg("picture"), py::arg("exposure_stops") = 0.0,
             "Write a picture as .png (light is developed first, bytes stay) or .exr (light).");
}

}  // namespace brisance::python
