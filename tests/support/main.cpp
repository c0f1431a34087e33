#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>

// fontconfig, which cairo asks for fonts, keeps its configuration until the process ends. Read by the leak sanitizer only.
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig"; }
