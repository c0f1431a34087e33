#include "suture/view/view_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/atomic_file.hpp"
#include "suture/errors.hpp"
#include "view/page_text.hpp"
#include "view/viewer_data.hpp"

namespace suture {
namespace {

std::vector<int> spread(int count, int maximum) {
  if (maximum < 1) throw InputError(fmt::format("a page of {} frames shows nothing", maximum));
  std::vector<int> frames;
  const int shown = std::min(count, maximum);
  for (int k = 0; k < shown; ++k)
    frames.push_back(shown == 1 ? 0 : static_cast<int>(static_cast<long>(count - 1) * k / (shown - 1)));
  return frames;
}

/// Every occurrence; what is put in is not searched again.
void replace(std::string& text, std::string_view mark, const std::string& by) {
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + by.size()))
    text.replace(at, mark.size(), by);
}

// "</script>" inside a string would end the script element; JSON may write the slash as "\/".
std::string inside_script(std::string json) {
  for (std::size_t at = json.find("</"); at != std::string::npos; at = json.find("</", at + 3)) json.insert(at + 1, 1, '\\');
  return json;
}

std::string inside_html(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') result += "&amp;";
    else if (c == '<') result += "&lt;";
    else result += c;
  }
  return result;
}

}  // namespace

ViewPage write_view_page(const Replay& replay, const ViewRequest& request, const std::filesystem::path& path) {
  const std::vector<int> frames = spread(replay.frame_count(), request.maximum_frames);
  const ViewerData data = viewer_data(replay, frames);
  std::string page = page_html;
  replace(page, "{{style}}", page_style);
  replace(page, "{{script}}", page_script);
  replace(page, "{{description}}", inside_script(data.description.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)));
  replace(page, "{{numbers}}", data.numbers.base64());
  replace(page, "{{title}}", inside_html(request.title));
  write_file_atomically(path, page);
  return {static_cast<int>(frames.size()), page.size()};
}

}  // namespace suture
