#include "render/canvas.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>

#include "io/atomic_file.hpp"
#include "suture/errors.hpp"

namespace suture {
namespace {

cairo_status_t collect(void* target, const unsigned char* data, unsigned int length) {
  try {
    static_cast<std::string*>(target)->append(reinterpret_cast<const char*>(data), length);
  } catch (...) {  // must not cross cairo's C frames
    return CAIRO_STATUS_NO_MEMORY;
  }
  return CAIRO_STATUS_SUCCESS;
}

cairo_surface_t* make_surface(const std::filesystem::path& path, int width, int height, std::string* bytes) {
  const std::string ending = path.extension().string();
  if (ending == ".png") return cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  if (ending == ".svg") return cairo_svg_surface_create_for_stream(collect, bytes, width, height);
  if (ending == ".pdf") return cairo_pdf_surface_create_for_stream(collect, bytes, width, height);
  throw InputError(fmt::format("{}: pictures end in .png, .svg or .pdf", path.string()));
}

}  // namespace

Canvas::Canvas(std::filesystem::path path, int width, int height) : path_(std::move(path)) {
  surface_.reset(make_surface(path_, width, height, &bytes_));
  prepare(width, height);
}

Canvas::Canvas(int width, int height) {
  surface_.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  prepare(width, height);
}

void Canvas::prepare(int width, int height) {
  context_.reset(cairo_create(surface_.get()));
  if (const cairo_status_t status = cairo_status(context_.get()); status != CAIRO_STATUS_SUCCESS)
    throw InputError(fmt::format("a picture of {} x {} pixels: {}", width, height, cairo_status_to_string(status)));
  set_colour(context(), {1.0, 1.0, 1.0});
  cairo_paint(context());
  cairo_select_font_face(context(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_line_join(context(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(context(), CAIRO_LINE_CAP_ROUND);
}

void Canvas::finish() {
  cairo_status_t status = cairo_status(context());
  if (status == CAIRO_STATUS_SUCCESS && path_.extension() == ".png")
    status = cairo_surface_write_to_png_stream(surface_.get(), collect, &bytes_);
  cairo_surface_finish(surface_.get());
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface_.get());
  if (status != CAIRO_STATUS_SUCCESS)
    throw FileError(fmt::format("{}: the picture failed: {}", path_.string(), cairo_status_to_string(status)));
  write_file_atomically(path_, bytes_);
}

std::vector<unsigned char> Canvas::pixels() const {
  cairo_surface_flush(surface_.get());
  const unsigned char* const data = cairo_image_surface_get_data(surface_.get());
  const std::size_t stride = cairo_image_surface_get_stride(surface_.get());
  const std::size_t row = 4 * static_cast<std::size_t>(cairo_image_surface_get_width(surface_.get()));
  std::vector<unsigned char> bytes;
  for (int y = 0; y < cairo_image_surface_get_height(surface_.get()); ++y)
    bytes.insert(bytes.end(), data + y * stride, data + y * stride + row);
  return bytes;
}

void set_colour(cairo_t* context, const Colour& colour, double opacity) {
  cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, opacity);
}

double draw_text(cairo_t* context, const std::string& text, double x, double y, double size, Align align, bool bold) {
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, size);
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  const double shift = align == Align::left ? 0.0 : align == Align::centre ? 0.5 : 1.0;
  cairo_move_to(context, x - shift * extents.x_advance, y);
  cairo_show_text(context, text.c_str());
  cairo_new_path(context);
  return extents.x_advance;
}

}  // namespace suture
