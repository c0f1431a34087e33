#include <catch2/catch.hpp>
#include <cctype>
#include <numbers>
#include <set>
#include <vector>

#include "support/file_bytes.hpp"
#include "support/program.hpp"
#include "support/sample_tissue.hpp"
#include "suture/errors.hpp"
#include "suture/render/frame.hpp"

using namespace suture;
using namespace suture::test;
using Catch::Matchers::Contains;

namespace {

const UnitScales scales{UnitParameters{}};

int big_endian(const std::string& bytes, std::size_t at) {
  int value = 0;
  for (std::size_t i = at; i < at + 4; ++i) value = 256 * value + static_cast<unsigned char>(bytes.at(i));
  return value;
}

// Every opened element is closed in order. Enough for cairo's SVG, which has no CDATA and no '>' inside attributes.
bool tags_balance(const std::string& text) {
  std::vector<std::string> open;
  int elements = 0;
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = text.substr(at + 1, end - at - 1);
    if (tag.starts_with('?') || tag.starts_with('!')) continue;
    const std::size_t start = tag.starts_with('/') ? 1 : 0;
    const std::string name = tag.substr(start, tag.find_first_of(" /\n", start) - start);
    if (start == 1) {
      if (open.empty() || open.back() != name) return false;
      open.pop_back();
    } else if (!tag.ends_with('/')) {
      open.push_back(name);
    }
    ++elements;
  }
  return open.empty() && elements > 100;
}

FrameStyle sample_style() {
  FrameStyle style{.scales = scales, .width = 400, .height = 300};
  style.wound_outline = {{-0.5, -0.5}, {0.5, -0.5}, {0.0, 0.6}};
  style.wound_fraction = 0.42;
  return style;
}

}  // namespace

TEST_CASE("the well-formedness check of these tests can fail", "[unit]") {
  std::string many;
  for (int i = 0; i < 200; ++i) many += "<a b=\"c\"/>";
  CHECK(tags_balance("<svg>" + many + "</svg>"));
  CHECK(!tags_balance("<svg>" + many));
  CHECK(!tags_balance("<svg><g>" + many + "</svg></g>"));
}

TEST_CASE("a frame becomes a PNG of the asked size", "[unit]") {
  const TemporaryDirectory folder;
  render_frame(sample_tissue(), sample_style(), folder.path() / "frame.png");
  const std::string bytes = read_bytes(folder.path() / "frame.png");
  REQUIRE(bytes.size() > 5000);
  CHECK(bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n");
  CHECK(big_endian(bytes, 16) == 400);
  CHECK(big_endian(bytes, 20) == 300);
  CHECK(bytes.substr(bytes.size() - 8, 4) == "IEND");
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}

TEST_CASE("a frame becomes a well-formed SVG, and a PDF", "[unit]") {
  const TemporaryDirectory folder;
  render_frame(sample_tissue(), sample_style(), folder.path() / "frame.svg");
  const std::string text = read_bytes(folder.path() / "frame.svg");
  CHECK(text.starts_with("<?xml"));
  CHECK_THAT(text, Contains("width=\"400") && Contains("height=\"300"));
  CHECK(tags_balance(text));
  render_frame(sample_tissue(), sample_style(), folder.path() / "frame.pdf");
  CHECK(read_bytes(folder.path() / "frame.pdf").starts_with("%PDF-"));
}

TEST_CASE("what is drawn depends on the state and the style", "[unit]") {
  const TemporaryDirectory folder;
  std::set<std::string> pictures;
  const auto draw = [&](const TissueState& state, const FrameStyle& style) {
    render_frame(state, style, folder.path() / "frame.png");
    pictures.insert(read_bytes(folder.path() / "frame.png"));
  };
  TissueState state = sample_tissue();
  FrameStyle style = sample_style();
  draw(state, style);
  draw(state, style);
  CHECK(pictures.size() == 1);  // the same input gives the same picture
  style.wound_fraction = 0.43;
  draw(state, style);
  style.wound_outline.clear();
  draw(state, style);
  style.field = CellField{{"area", "area", "cell area"}, std::vector<double>(state.tissue.cell_count(), 1.0)};
  draw(state, style);
  style.field->values[3] = 2.0;
  draw(state, style);
  style.membrane_width = 0.05;
  draw(state, style);
  style.view = View{.centre = {1.0, 0.0}, .half_width = 1.0};
  draw(state, style);
  state.mutable_view().x[state.tissue.vertex_count()] += 0.2;  // a purse-string vertex
  draw(state, style);
  style.coloured = false;
  draw(state, style);
  CHECK(pictures.size() == 9);
}

TEST_CASE("a strip holds its panels side by side", "[unit]") {
  const TemporaryDirectory folder;
  std::vector<StripPanel> panels(3, {sample_tissue(), sample_style()});
  panels[1].state.time = 50.0;
  render_strip(panels, 200, folder.path() / "strip.png");
  const std::string bytes = read_bytes(folder.path() / "strip.png");
  CHECK(big_endian(bytes, 16) > 600);
  CHECK(big_endian(bytes, 16) < 800);
  CHECK(big_endian(bytes, 20) > 200);
  CHECK(big_endian(bytes, 20) < 300);
}

TEST_CASE("a one-cell experiment shows the initial outline, plates and forces", "[unit]") {
  const TemporaryDirectory folder;
  const TissueState tissue = sample_tissue(1);
  std::vector<StripPanel> panels(2, {tissue, FrameStyle{.scales = scales}});
  render_cell_experiment(panels, 150, folder.path() / "plain.svg");
  panels[1].style.plates = {{{-1.0, 1.0}, {1.0, 1.0}}};
  panels[1].style.forces = {{{0.0, 0.0}, {0.3, 0.0}}};
  render_cell_experiment(panels, 150, folder.path() / "loaded.svg");
  const std::string plain = read_bytes(folder.path() / "plain.svg"), loaded = read_bytes(folder.path() / "loaded.svg");
  CHECK(tags_balance(plain));
  CHECK_THAT(plain, Contains("stroke-dasharray"));
  CHECK(plain != loaded);
}

TEST_CASE("the shape parameter of a regular polygon is n/pi tan(pi/n)", "[unit]") {
  constexpr int n = 7;
  TissueState state{.tissue = Tissue({n}, {CellMaterial{}}, std::vector<double>(n, 1.0))};
  state.values.assign(state.layout().size(), 1.0);
  for (int k = 0; k < n; ++k) {
    state.mutable_view().x[k] = 3.0 * std::cos(2.0 * std::numbers::pi * k / n);
    state.mutable_view().y[k] = 3.0 * std::sin(2.0 * std::numbers::pi * k / n);
  }
  const CellField field = shape_parameter_field(state);
  REQUIRE(field.values.size() == 1);
  CHECK(field.values[0] == Approx(n / std::numbers::pi * std::tan(std::numbers::pi / n)));
}

TEST_CASE("what cannot be drawn is refused", "[unit]") {
  const TemporaryDirectory folder;
  FrameStyle style = sample_style();
  CHECK_THROWS_WITH(render_frame(sample_tissue(), style, folder.path() / "frame.bmp"), Contains(".png, .svg or .pdf"));
  CHECK_THROWS_AS(render_frame(TissueState{}, style, folder.path() / "frame.png"), InputError);
  CHECK_THROWS_AS(render_strip({}, 200, folder.path() / "frame.png"), InputError);
  CHECK_THROWS_AS(render_frame(sample_tissue(), style, folder.path() / "missing" / "frame.png"), FileError);
  style.field = CellField{{"area", "area", ""}, {1.0}};
  CHECK_THROWS_WITH(render_frame(sample_tissue(), style, folder.path() / "frame.png"),
                    Contains("1 values for 18 cells"));
  style.field.reset();
  style.width = -1;
  CHECK_THROWS_AS(render_frame(sample_tissue(), style, folder.path() / "frame.png"), InputError);
}
