#include "report/drawing/bitmap.hpp"

#include <png.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/safe_text.hpp"

namespace enfilade {

namespace {

void append(png_structp png, png_bytep data, png_size_t size) {
  auto* bytes = static_cast<std::string*>(png_get_io_ptr(png));
  bytes->append(reinterpret_cast<const char*>(data), size);
}

void flush(png_structp) {}

[[noreturn]] void fail(png_structp, png_const_charp message) {
  throw RunError(std::string("the PNG library says: ") + message);
}

void ignore(png_structp, png_const_charp) {}

void describe(png_structp png, png_infop info, const std::string& text) {
  if (text.empty()) return;
  std::string key = "Description", value = file_text(text);
  png_text chunk{};
  chunk.compression = PNG_TEXT_COMPRESSION_NONE;
  chunk.key = key.data();
  chunk.text = value.data();
  chunk.text_length = value.size();
  png_set_text(png, info, &chunk, 1);
}

/// libpng's two structures, freed together.
struct PngWriter {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  PngWriter() = default;
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;
  ~PngWriter() { png_destroy_write_struct(&png, &info); }
};

}  // namespace

void Bitmap::fill(int x, int y, int w, int h, Rgb8 colour) {
  for (int j = std::max(0, y); j < std::min(height, y + h); ++j) {
    for (int i = std::max(0, x); i < std::min(width, x + w); ++i) at(i, j) = colour;
  }
}

std::string encode_png(const Bitmap& bitmap, const std::string& text) {
  ENFILADE_CHECK(bitmap.width > 0 && bitmap.height > 0, std::to_string(bitmap.width));
  PngWriter writer;
  if (writer.info == nullptr) throw RunError("the PNG library cannot start");
  std::string bytes;
  png_set_write_fn(writer.png, &bytes, append, flush);
  png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(bitmap.width),
               static_cast<png_uint_32>(bitmap.height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
  describe(writer.png, writer.info, text);
  png_write_info(writer.png, writer.info);
  for (int y = 0; y < bitmap.height; ++y) png_write_row(writer.png, bitmap.at(0, y).data());
  png_write_end(writer.png, writer.info);
  return bytes;
}

}  // namespace enfilade
