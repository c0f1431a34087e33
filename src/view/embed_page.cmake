# Run at build time: writes the files of page/ as C++ raw strings. SCRIPTS: names of the scripts, in order, by commas.
file(READ ${PAGE}/page.html html)
file(READ ${PAGE}/style.css style)
set(script "")
string(REPLACE "," ";" SCRIPTS "${SCRIPTS}")
foreach(name IN LISTS SCRIPTS)
  file(READ ${PAGE}/${name} text)
  string(APPEND script "${text}")
endforeach()
file(WRITE ${OUTPUT} "#include \"view/page_text.hpp\"
namespace suture {
const char* const page_html = R\"~~~~(${html})~~~~\";
const char* const page_style = R\"~~~~(${style})~~~~\";
const char* const page_script = R\"~~~~(${script})~~~~\";
}
")
