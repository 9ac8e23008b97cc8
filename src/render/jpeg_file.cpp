#include <csetjmp>
#include <cstdio>
// jpeglib.h wants the standard types above.
#include <jpeglib.h>

#include "render/decoders.h"

namespace brisance {
namespace {

/// libjpeg reports through C callbacks; jumping back keeps exceptions out of its frames.
struct JpegTrouble {
  jpeg_error_mgr manager{};
  std::jmp_buf back;
  char message[JMSG_LENGTH_MAX] = "";
};

void jumpBack(j_common_ptr codec) {
  auto& trouble = *reinterpret_cast<JpegTrouble*>(codec->err);
  codec->err->format_message(codec, trouble.message);
  std::longjmp(trouble.back, 1);
}

/// A warning means bytes that are corrupt or missing, which libjpeg would paint over with grey: as bad as an error.
void rejectWarnings(j_common_ptr codec, int level) {
  if (level < 0) jumpBack(codec);
}

/// A decoder whose memory is given back however reading ends.
struct Decoder {
  Decoder() { jpeg_create_decompress(&codec); }
  ~Decoder() { jpeg_destroy_decompress(&codec); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  jpeg_decompress_struct codec{};
};

// Nothing with a destructor lives in the two functions that libjpeg may jump out of.
bool readHeader(jpeg_decompress_struct& codec, JpegTrouble& trouble, const std::string& bytes) {
  if (setjmp(trouble.back)) return false;
  jpeg_mem_src(&codec, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&codec, TRUE);
  codec.out_color_space = JCS_RGB;
  codec.dct_method = JDCT_ISLOW;
  return true;
}

bool readRows(jpeg_decompress_struct& codec, JpegTrouble& trouble, Picture& picture) {
  if (setjmp(trouble.back)) return false;
  jpeg_start_decompress(&codec);
  while (codec.output_scanline < codec.output_height) {
    JSAMPROW row = picture.rgb.data() + std::size_t{3} * codec.output_scanline * codec.output_width;
    jpeg_read_scanlines(&codec, &row, 1);
  }
  jpeg_finish_decompress(&codec);
  return true;
}

}  // namespace

Picture decodeJpeg(const std::string& bytes, const std::string& fileName) {
  JpegTrouble trouble;
  Decoder decoder;
  decoder.codec.err = jpeg_std_error(&trouble.manager);
  trouble.manager.error_exit = jumpBack;
  trouble.manager.emit_message = rejectWarnings;
  const auto reject = [&]() -> DamagedFile {
    return DamagedFile(fmt::format("{}: not a whole RGB or grey JPEG picture: {}", fileName, trouble.message));
  };
  if (!readHeader(decoder.codec, trouble, bytes)) throw reject();
  Picture picture = emptyPicture(decoder.codec.image_width, decoder.codec.image_height, fileName);
  if (!readRows(decoder.codec, trouble, picture)) throw reject();
  return picture;
}

}  // namespace brisance
