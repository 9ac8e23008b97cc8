#include "render/picture_file.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
// jpeglib.h wants the standard types above.
#include <jpeglib.h>

#include "base/check.h"

using namespace brisance;

namespace {

Picture gradient(int width, int height) {
  Picture picture{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const int value : {255 * x / width, 255 * y / height, 128})
        picture.rgb.push_back(static_cast<std::uint8_t>(value));
  return picture;
}

std::string jpegOf(Picture picture, int quality) {
  jpeg_compress_struct codec{};
  jpeg_error_mgr errors{};
  codec.err = jpeg_std_error(&errors);
  jpeg_create_compress(&codec);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&codec, &memory, &size);
  codec.image_width = static_cast<unsigned>(picture.width);
  codec.image_height = static_cast<unsigned>(picture.height);
  codec.input_components = 3;
  codec.in_color_space = JCS_RGB;
  jpeg_set_defaults(&codec);
  jpeg_set_quality(&codec, quality, TRUE);
  jpeg_start_compress(&codec, TRUE);
  for (int y = 0; y < picture.height; ++y) {
    JSAMPROW row = &picture.rgb[std::size_t{3} * y * picture.width];
    jpeg_write_scanlines(&codec, &row, 1);
  }
  jpeg_finish_compress(&codec);
  jpeg_destroy_compress(&codec);
  const std::unique_ptr<unsigned char, decltype(&std::free)> owned(memory, std::free);
  return {reinterpret_cast<char*>(memory), size};
}

void expectDamaged(const std::string& bytes) {
  try {
    decodePicture(bytes, "wall.png");
    ADD_FAILURE() << "accepted " << bytes.size() << " bytes";
  } catch (const DamagedFile& error) {
    EXPECT_EQ(std::string(error.what()).find("wall.png: "), 0u) << error.what();
  }
}

}  // namespace

TEST(Png, ComesBackAsItWas) {
  const Picture picture = gradient(37, 23);
  EXPECT_EQ(decodePicture(encodePng(picture), "test.png"), picture);
}

TEST(Png, EqualPicturesAreEqualFiles) { EXPECT_EQ(encodePng(gradient(9, 5)), encodePng(gradient(9, 5))); }

TEST(Png, CutShortAnywhereIsDamaged) {
  const std::string whole = encodePng(gradient(20, 20));
  for (std::size_t size = 0; size + 12 < whole.size(); size += 7) expectDamaged(whole.substr(0, size));
}

TEST(Png, FlippedBytesInThePixelsAreDamaged) {
  std::string bytes = encodePng(gradient(20, 20));
  bytes[bytes.size() / 2] ^= 0x55;
  expectDamaged(bytes);
}

TEST(Jpeg, ComesBackToItsQuality) {
  const Picture picture = gradient(32, 32), back = decodePicture(jpegOf(picture, 95), "test.jpg");
  ASSERT_EQ(back.rgb.size(), picture.rgb.size());
  double sum = 0;
  for (std::size_t i = 0; i < back.rgb.size(); ++i) sum += std::abs(back.rgb[i] - picture.rgb[i]);
  EXPECT_LT(sum / static_cast<double>(back.rgb.size()), 3);  // of 255, a smooth picture at quality 95
}

TEST(Jpeg, CutShortIsDamaged) {
  const std::string whole = jpegOf(gradient(64, 64), 90);
  for (const std::size_t size : {std::size_t{3}, whole.size() / 4, whole.size() / 2, whole.size() - 20})
    expectDamaged(whole.substr(0, size));
}

TEST(PictureFile, OtherKindsOfFilesAreNamedAsSuch) {
  expectDamaged("");
  expectDamaged("GIF89a and more");
}

TEST(Exr, ComesBackToHalfPrecision) {
  Image image(19, 11);
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 19; ++x) image(x, y) = {0.001f * static_cast<float>(x * x), 3.7f * static_cast<float>(y), 1000};
  const Image back = decodeExr(encodeExr(image), "test.exr");
  ASSERT_EQ(back.width, 19);
  ASSERT_EQ(back.height, 11);
  constexpr float halfRounding = 1.0f / 2048;  // 11 significant bits, rounded to nearest
  for (std::size_t p = 0; p < image.pixels.size(); ++p)
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(back.pixels[p][channel], image.pixels[p][channel], halfRounding * image.pixels[p][channel]);
}

TEST(Exr, LightBeyondHalfFloatsIsTheLargestOfThem) {
  Image image(1, 1);
  image(0, 0) = {1e30f, 7, 0};
  EXPECT_EQ(decodeExr(encodeExr(image), "test.exr")(0, 0), Vec3f(65504, 7, 0));
}

TEST(Exr, HoldsNoDateSoEqualImagesAreEqualFiles) {
  const std::string bytes = encodeExr(Image(8, 8));
  EXPECT_EQ(bytes, encodeExr(Image(8, 8)));
  EXPECT_EQ(bytes.find("Date"), std::string::npos);
}

TEST(Exr, DamageIsReported) {
  const std::string whole = encodeExr(Image(32, 32));
  EXPECT_THROW(decodeExr(whole.substr(0, whole.size() / 2), "test.exr"), DamagedFile);
  EXPECT_THROW(decodeExr("no exr", "test.exr"), DamagedFile);
}
