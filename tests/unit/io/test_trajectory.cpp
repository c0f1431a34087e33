#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "io/trajectory_file.hpp"
#include "io/trajectory_parts.hpp"
#include "support/file_bytes.hpp"
#include "support/program.hpp"
#include "support/sample_tissue.hpp"
#include "suture/errors.hpp"
#include "suture/io/trajectory.hpp"
#include "suture/io/trajectory_check.hpp"
#include "suture/version.hpp"

using namespace suture;
using namespace suture::test;
using Catch::Matchers::Contains;

namespace {

bool same_bits(std::span<const double> a, std::span<const double> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

void check_same_state(const TissueState& a, const TissueState& b) {
  CHECK(same_bits({&a.time, 1}, {&b.time, 1}));
  CHECK(same_bits(a.values, b.values));
  CHECK(same_bits(a.reference_rest_length, b.reference_rest_length));
  CHECK(same_bits(a.tissue.initial_rest_lengths(), b.tissue.initial_rest_lengths()));
  CHECK(a.tissue.mean_initial_rest_length() == b.tissue.mean_initial_rest_length());
  REQUIRE(a.tissue.cell_count() == b.tissue.cell_count());
  for (int cell = 0; cell < a.tissue.cell_count(); ++cell) {
    CHECK(a.tissue.vertex_count(cell) == b.tissue.vertex_count(cell));
    const CellMaterial p = a.tissue.material(cell), q = b.tissue.material(cell);
    const double first[] = {p.rest_area, p.area_stiffness, p.membrane_stiffness, p.bending_stiffness, p.tau, p.memory};
    const double second[] = {q.rest_area, q.area_stiffness, q.membrane_stiffness, q.bending_stiffness, q.tau, q.memory};
    CHECK(same_bits(first, second));
  }
  const PurseString &r = a.purse_string, &s = b.purse_string;
  CHECK(r.vertex == s.vertex);
  CHECK(r.mode == s.mode);
  REQUIRE(r.spring.size() == s.spring.size());
  for (int j = 0; j < r.size(); ++j) {
    const double first[] = {r.spring[j].rest_length, r.spring[j].start_time, r.spring[j].reference_length};
    const double second[] = {s.spring[j].rest_length, s.spring[j].start_time, s.spring[j].reference_length};
    CHECK(same_bits(first, second));
  }
  const double first[] = {r.shrink_rate, r.minimum_rest_length}, second[] = {s.shrink_rate, s.minimum_rest_length};
  CHECK(same_bits(first, second));
}

std::string without_seal(std::string bytes) {
  bytes.resize(bytes.size() - 16);
  return bytes;
}

Provenance sample_provenance() {
  return {.config_text = std::string(100000, '#') + "\n[tissue]\nseed = 7\n",  // longer than an attribute may be
          .resolved_config = "[tissue]\nseed = 7\ncells = 18\n",
          .command_line = "suture run embryo.toml --set name=\"\xc3\xa9\"",
          .start_time = utc_now(),
          .seed = std::numeric_limits<std::uint64_t>::max(),
          .threads = 2,
          .position_tolerance = 1e-3,
          .rest_length_tolerance = 1e-4,
          .units = {.rest_area_um2 = 16.1, .unsticking_force_nN = 1.0 / 3.0, .constriction_rate_um_per_s = 0.31}};
}

const Quantity wound_area{"wound_area", "area", "area of the wound"};

// Three frames (the second with another ring), two stages, one series, two events.
void write_sample(const std::filesystem::path& path) {
  TrajectoryWriter writer(path, sample_provenance());
  TissueState state = sample_tissue();
  TissueState packed = state;
  packed.purse_string = {};
  packed.values.erase(packed.values.begin() + state.tissue.vertex_count(),
                      packed.values.begin() + state.layout().points());
  packed.values.erase(packed.values.begin() + 2 * state.tissue.vertex_count(),
                      packed.values.end() - state.tissue.vertex_count());
  packed.reference_rest_length = {};
  writer.write_stage(Stage::packing, packed);
  const CellField shape{{"shape_parameter", "1", "p^2/(4 pi a)"}, std::vector<double>(state.tissue.cell_count(), 1.2)};
  writer.write_frame(state, {.cell_fields = {shape}, .wound_outline = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0 / 3.0}}});
  for (int i = 0; i < 3000; ++i) writer.record(wound_area, 0.1 * i, std::exp(-0.001 * i));
  writer.record(StoredEvent{33.5, "yield", 3, 41});
  writer.commit();
  packed.time = 40.0;
  packed.reference_rest_length = state.reference_rest_length;
  writer.write_frame(packed);
  writer.record(StoredEvent{33.6, "closure", {}, {}});
  state.time = 41.0;
  writer.write_frame(state);
  writer.write_stage(Stage::closure, state);
  writer.write_summary({.status = RunStatus::closed, .seed = 7});
  writer.write_summary({.status = RunStatus::closed, .seed = 8});
  writer.close();
}

}  // namespace

TEST_CASE("a trajectory reads back bit for bit", "[unit]") {
  const TemporaryDirectory folder;
  write_sample(folder.path() / "run.h5");
  const Trajectory trajectory = read_trajectory(folder.path() / "run.h5");

  CHECK(trajectory.complete);
  REQUIRE(trajectory.frames.size() == 3);
  const TissueState original = sample_tissue();
  check_same_state(trajectory.state(0), original);
  CHECK(trajectory.frames[1].purse_string.empty());
  CHECK(trajectory.frames[2].time == 41.0);
  REQUIRE(trajectory.stages.size() == 2);
  CHECK(trajectory.stages.at(Stage::packing).reference_rest_length.empty());
  TissueState last = original;
  last.time = 41.0;
  check_same_state(trajectory.stages.at(Stage::closure), last);
  const auto [stage, state] = read_last_stage(folder.path() / "run.h5");
  CHECK(stage == Stage::closure);
  check_same_state(state, last);

  const FrameExtras& extras = trajectory.frames[0].extras;
  REQUIRE(extras.cell_fields.size() == 1);
  CHECK(extras.cell_fields[0].quantity.name == "shape_parameter");
  CHECK(extras.cell_fields[0].quantity.description == "p^2/(4 pi a)");
  REQUIRE(extras.wound_outline.size() == 3);
  CHECK(extras.wound_outline[2].y == 1.0 / 3.0);

  const Series* const series = trajectory.observable("wound_area");
  REQUIRE(series != nullptr);
  REQUIRE(series->value.size() == 3000);
  CHECK(series->value[2999] == std::exp(-0.001 * 2999));
  CHECK(series->quantity.unit == "area");
  CHECK(trajectory.observable("nothing") == nullptr);
  REQUIRE(trajectory.events.size() == 2);
  CHECK(trajectory.events[0] == StoredEvent{33.5, "yield", 3, 41});
  CHECK(trajectory.events[1] == StoredEvent{33.6, "closure", {}, {}});
  CHECK_THAT(trajectory.summary, Contains("\"seed\": 8"));
}

TEST_CASE("a trajectory carries its provenance", "[unit]") {
  const TemporaryDirectory folder;
  write_sample(folder.path() / "run.h5");
  const Trajectory trajectory = read_trajectory(folder.path() / "run.h5");
  const Provenance expected = sample_provenance(), &found = trajectory.provenance;
  CHECK(found.config_text == expected.config_text);
  CHECK(found.resolved_config == expected.resolved_config);
  CHECK(found.command_line == expected.command_line);
  CHECK(found.parent.empty());
  CHECK(found.seed == expected.seed);
  CHECK(found.threads == 2);
  CHECK(found.position_tolerance == 1e-3);
  CHECK(found.rest_length_tolerance == 1e-4);
  CHECK(found.units.rest_area_um2 == expected.units.rest_area_um2);
  CHECK(found.units.unsticking_force_nN == expected.units.unsticking_force_nN);
  CHECK(found.units.constriction_rate_um_per_s == expected.units.constriction_rate_um_per_s);
  CHECK(trajectory.code_version == build_information().version);
  CHECK(!trajectory.code_commit.empty());
}

TEST_CASE("what was committed is readable from the journal, what was not is lost", "[unit]") {
  const TemporaryDirectory folder;
  {
    TrajectoryWriter writer(folder.path() / "run.h5", sample_provenance());
    writer.write_frame(sample_tissue());
    CHECK(std::filesystem::is_empty(folder.path()));
    writer.commit();
    TissueState later = sample_tissue();
    later.time += 1.0;
    writer.write_frame(later);
    writer.record(wound_area, 1.0, 2.0);
  }  // stopped without close(): what came after the commit is lost, what came before is not
  for (const char* name : {"run.journal", "run.h5"}) {  // there is no run.h5: the journal stands in
    const Trajectory trajectory = read_trajectory(folder.path() / name);
    CHECK(!trajectory.complete);
    CHECK(trajectory.frames.size() == 1);
  }
  const FileReport report = check_file(folder.path() / "run.journal");
  CHECK(report.verdict == FileVerdict::valid);
  CHECK_THAT(report.content, Contains("unfinished") && Contains("1 frames") && Contains("1 blocks"));
  // One that does not fit into memory is read by way of a scratch file.
  {
    const Hdf5File scratch = open_trajectory(folder.path() / "run.journal", 0);
    const Trajectory rest = read_all_but_frames(scratch.root());
    CHECK(rest.frames.empty());
    CHECK(rest.provenance.seed == sample_provenance().seed);
    REQUIRE(marked_frames(scratch.root()) == 1);
    check_same_state(state_of(rest, read_frame(scratch.root().group("frames"), 0, rest.tissue)), sample_tissue());
  }
  CHECK(folder.contents() == std::vector<std::string>{"run.journal"});
}

TEST_CASE("a published file says whether it is complete, and a writer goes on where another one was", "[unit]") {
  const TemporaryDirectory folder;
  const auto path = folder.path() / "run.h5";
  TissueState state = sample_tissue();
  std::uint64_t length = 0;
  {
    TrajectoryWriter writer(path, sample_provenance());
    writer.write_frame(state);
    writer.record(wound_area, 0.0, 3.0);
    writer.commit();
    length = writer.length();
    writer.record(wound_area, 1.0, 99.0);  // after the checkpoint: to be forgotten
    writer.publish(/*complete=*/false);
  }
  const FileReport report = check_file(path);
  CHECK(report.verdict == FileVerdict::invalid);
  REQUIRE(report.problems.size() == 1);
  CHECK_THAT(report.problems[0], Contains("did not finish"));
  CHECK_THROWS_AS(TrajectoryWriter::resume(path, length + 1), FileError);
  TrajectoryWriter writer = TrajectoryWriter::resume(path, length);
  CHECK_THROWS_AS(writer.write_frame(state), FileError);  // it knows the last time
  state.time += 1.0;
  writer.write_frame(state);
  writer.record(wound_area, 1.0, 2.0);
  writer.record(Continuation{state.time - 1.0, true, utc_now()});
  writer.close();
  CHECK(folder.contents() == std::vector<std::string>{"run.h5"});
  const Trajectory trajectory = read_trajectory(path);
  CHECK(trajectory.complete);
  CHECK(trajectory.frames.size() == 2);
  CHECK(trajectory.observable("wound_area")->value == std::vector<double>{3.0, 2.0});
  REQUIRE(trajectory.continuations.size() == 1);
  CHECK(trajectory.continuations[0].reproducible);
  CHECK(check_file(path).verdict == FileVerdict::valid);
  const FrameReader frames(path);
  REQUIRE(frames.count() == 2);
  CHECK(frames.time(1) == state.time);
  check_same_state(frames.state(1), state);
}

TEST_CASE("a stage that is written again replaces itself and what came after it", "[unit]") {
  const TemporaryDirectory folder;
  TrajectoryWriter writer(folder.path() / "run.h5", sample_provenance());
  TissueState state = sample_tissue();
  writer.write_stage(Stage::packing, state);
  writer.write_stage(Stage::anneal, state);
  writer.commit();
  state.time = 77.0;
  writer.write_stage(Stage::packing, state);
  writer.close();
  const Trajectory trajectory = read_trajectory(folder.path() / "run.h5");
  REQUIRE(trajectory.stages.size() == 1);
  CHECK(trajectory.stages.at(Stage::packing).time == 77.0);
}

TEST_CASE("content that differs from its recorded hash is found by check", "[unit]") {
  const TemporaryDirectory folder;
  write_sample(folder.path() / "run.h5");
  // Without the seal, as after a program that has changed the file.
  const std::string bytes = without_seal(read_bytes(folder.path() / "run.h5"));
  write_bytes(folder.path() / "damaged.h5", bytes);
  CHECK(check_file(folder.path() / "damaged.h5").verdict == FileVerdict::valid);
  // One bit in the last digit of a number of: a frame, a series, the events.
  const double frame = sample_tissue().values[3], series = std::exp(-0.001 * 2000), event = 33.6;
  for (const double value : {frame, series, event}) {
    const std::string pattern(reinterpret_cast<const char*>(&value), sizeof value);
    const std::size_t position = bytes.rfind(pattern);
    REQUIRE(position != std::string::npos);
    std::string damaged = bytes;
    damaged[position] = static_cast<char>(damaged[position] ^ 1);
    write_bytes(folder.path() / "damaged.h5", damaged);
    const FileReport report = check_file(folder.path() / "damaged.h5");
    CHECK(report.verdict == FileVerdict::invalid);
    REQUIRE(!report.problems.empty());
    CHECK_THAT(report.problems[0], Contains("does not have the recorded hash"));
  }
}

TEST_CASE("a writer refuses frames that do not belong together", "[unit]") {
  const TemporaryDirectory folder;
  TrajectoryWriter writer(folder.path() / "run.h5", sample_provenance());
  TissueState state = sample_tissue();
  writer.write_frame(state);
  CHECK_THROWS_AS(writer.write_frame(state), FileError);  // same time
  TissueState other = sample_tissue(3);
  other.time = 99.0;
  CHECK_THROWS_WITH(writer.write_frame(other), Contains("another tissue"));
  writer.close();
  state.time = 99.0;
  CHECK_THROWS_AS(writer.write_frame(state), FileError);
  CHECK_THROWS_AS(writer.commit(), FileError);
}

TEST_CASE("a folder that does not exist is reported by name and leaves nothing behind", "[unit]") {
  const TemporaryDirectory folder;
  TrajectoryWriter writer(folder.path() / "missing" / "run.h5", sample_provenance());
  CHECK_THROWS_WITH(writer.close(), Contains("missing/run.journal") && Contains("No such file"));
  std::filesystem::create_directory(folder.path() / "missing");
  writer.close();  // the failure cost nothing: the trajectory is still in memory
  CHECK(read_trajectory(folder.path() / "missing" / "run.h5").complete);
}

TEST_CASE("files that are not trajectories are refused with the reason", "[unit]") {
  const TemporaryDirectory folder;
  CHECK_THROWS_WITH(read_trajectory(folder.path() / "absent.h5"), Contains("absent.h5"));
  CHECK_THROWS_AS(read_trajectory(folder.path() / "absent.h5"), InputError);
  write_bytes(folder.path() / "text.h5", "this is no HDF5 file");
  CHECK_THROWS_WITH(read_trajectory(folder.path() / "text.h5"), Contains("cannot be opened as an HDF5 file"));
  CHECK(check_file(folder.path() / "text.h5").verdict == FileVerdict::unreadable);
  CHECK(check_file(folder.path() / "absent.h5").verdict == FileVerdict::unreadable);
  CHECK(check_file(folder.path()).verdict == FileVerdict::unreadable);
  write_bytes(folder.path() / "empty.h5", "");
  CHECK(check_file(folder.path() / "empty.h5").verdict == FileVerdict::unreadable);

  write_sample(folder.path() / "run.h5");
  std::string bytes = without_seal(read_bytes(folder.path() / "run.h5"));
  write_bytes(folder.path() / "truncated.h5", bytes.substr(0, bytes.size() / 2));
  CHECK_THROWS_WITH(read_trajectory(folder.path() / "truncated.h5"),
                    Contains("truncated.h5") && Contains("truncated file"));
  CHECK(check_file(folder.path() / "truncated.h5").verdict == FileVerdict::unreadable);

  const std::size_t schema = bytes.find("suture-trajectory");
  REQUIRE(schema != std::string::npos);
  bytes[schema] = 'S';
  write_bytes(folder.path() / "foreign.h5", bytes);
  CHECK_THROWS_WITH(read_trajectory(folder.path() / "foreign.h5"), Contains("not a suture trajectory"));
  CHECK(check_file(folder.path() / "foreign.h5").verdict == FileVerdict::unreadable);
}

TEST_CASE("a file with any byte changed is refused before HDF5 sees it", "[unit]") {
  const TemporaryDirectory folder;
  {
    TrajectoryWriter writer(folder.path() / "run.h5", sample_provenance());
    writer.write_frame(sample_tissue(1));
    writer.close();
  }
  const std::string bytes = read_bytes(folder.path() / "run.h5");
  for (std::size_t position = 0; position + 16 < bytes.size(); position += 997) {
    std::string damaged = bytes;
    damaged[position] = static_cast<char>(~damaged[position]);
    write_bytes(folder.path() / "damaged.h5", damaged);
    CHECK_THROWS_WITH(read_trajectory(folder.path() / "damaged.h5"), Contains("its bytes are not those that were written"));
  }
}

TEST_CASE("check accepts a good trajectory and names what is wrong with a bad one", "[unit]") {
  const TemporaryDirectory folder;
  write_sample(folder.path() / "run.h5");
  const FileReport good = check_file(folder.path() / "run.h5");
  CHECK(good.verdict == FileVerdict::valid);
  CHECK(good.problems.empty());
  CHECK_THAT(good.content, Contains("18 cells, 3 frames, 2 stages, 1 observables, 2 events"));

  const auto problem_of = [&](const TissueState& state, double observed) {
    TrajectoryWriter writer(folder.path() / "bad.h5", sample_provenance());
    writer.write_frame(state);
    writer.record(wound_area, 0.0, observed);
    writer.close();
    const FileReport report = check_file(folder.path() / "bad.h5");
    CHECK(report.verdict == FileVerdict::invalid);
    REQUIRE(!report.problems.empty());
    return report.problems.front();
  };
  TissueState clockwise = sample_tissue();
  for (double& x : clockwise.mutable_view().x) x = -x;
  CHECK_THAT(problem_of(clockwise, 1.0), Contains("frame 0: cell 0 is not counter-clockwise"));
  TissueState infinite = sample_tissue();
  infinite.values[3] = std::numeric_limits<double>::infinity();
  CHECK_THAT(problem_of(infinite, 1.0), Contains("not finite"));
  TissueState collapsed = sample_tissue();
  collapsed.mutable_view().rest_length[30] = 0.0;
  CHECK_THAT(problem_of(collapsed, 1.0), Contains("rest length after cell 1"));
  CHECK_THAT(problem_of(sample_tissue(), std::nan("")), Contains("observable wound_area"));
}
