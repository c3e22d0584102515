// Photographs: PNG by libpng, JPEG by libjpeg-turbo, as rows of sRGB.
#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <cstring>

// jpeglib.h wants size_t and FILE
#include <jpeglib.h>

#include "reader.h"

namespace karinui::import {
namespace {

// Width and height as they were said, before anything is set aside for them.
bool within(std::uint64_t width, std::uint64_t height, const Limits& limits) {
  return width > 0 && height > 0 && width < 65536 && height < 65536 && width * height <= limits.points;
}

Reading readPng(const std::string& bytes, const Limits& limits) {
  Reading reading;
  png_image image;
  std::memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&image, bytes.data(), bytes.size())) {
    reading.refused = wire::Reason::Unreadable;
  } else if (!within(image.width, image.height, limits)) {
    reading.refused = wire::Reason::TooLarge;
  } else {
    image.format = PNG_FORMAT_RGB;
    reading.width = image.width, reading.height = image.height;
    reading.rgb.resize(PNG_IMAGE_SIZE(image));
    const png_color white{255, 255, 255};  // what is clear is unprinted cloth
    if (!png_image_finish_read(&image, &white, reading.rgb.data(), 0, nullptr))
      reading.refused = wire::Reason::Unreadable;
  }
  png_image_free(&image);
  return reading;
}

struct JpegTrouble {
  jpeg_error_mgr base;
  std::jmp_buf back;
};
void fail(j_common_ptr reader) { std::longjmp(reinterpret_cast<JpegTrouble*>(reader->err)->back, 1); }
void stayQuiet(j_common_ptr, int) {}

// Nothing with a destructor lives in here: libjpeg leaves it by a jump.
wire::Reason rowsOf(jpeg_decompress_struct& reader, JpegTrouble& trouble, const std::string& bytes,
                    const Limits& limits, Reading& into) {
  if (setjmp(trouble.back) != 0) return wire::Reason::Unreadable;
  jpeg_create_decompress(&reader);
  jpeg_mem_src(&reader, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  if (jpeg_read_header(&reader, TRUE) != JPEG_HEADER_OK) return wire::Reason::Unreadable;
  if (!within(reader.image_width, reader.image_height, limits)) return wire::Reason::TooLarge;
  reader.out_color_space = JCS_RGB;
  jpeg_start_decompress(&reader);
  if (reader.output_components != 3) return wire::Reason::Unsupported;
  into.width = reader.output_width, into.height = reader.output_height;
  into.rgb.resize(std::size_t{3} * reader.output_width * reader.output_height);
  while (reader.output_scanline < reader.output_height) {
    JSAMPROW row = into.rgb.data() + std::size_t{3} * reader.output_scanline * reader.output_width;
    jpeg_read_scanlines(&reader, &row, 1);
  }
  jpeg_finish_decompress(&reader);
  return wire::Reason::None;
}

Reading readJpeg(const std::string& bytes, const Limits& limits) {
  Reading reading;
  jpeg_decompress_struct reader;
  std::memset(&reader, 0, sizeof reader);
  JpegTrouble trouble;
  reader.err = jpeg_std_error(&trouble.base);
  trouble.base.error_exit = fail;
  trouble.base.emit_message = stayQuiet;
  reading.refused = rowsOf(reader, trouble, bytes, limits, reading);
  jpeg_destroy_decompress(&reader);
  return reading;
}

}  // namespace

Reading readPicture(const std::string& bytes, const Limits& limits) {
  if (bytes.starts_with("\x89PNG")) return readPng(bytes, limits);
  if (bytes.starts_with("\xff\xd8")) return readJpeg(bytes, limits);
  Reading reading;
  reading.refused = wire::Reason::Unreadable;
  return reading;
}

}  // namespace karinui::import
