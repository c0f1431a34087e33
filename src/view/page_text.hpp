// The files of page/ as text; embed_page.cmake writes their definitions at build time.
#pragma once

namespace suture {

extern const char* const page_html;
extern const char* const page_style;
extern const char* const page_script;  ///< page/*.js, one after the other

}  // namespace suture
