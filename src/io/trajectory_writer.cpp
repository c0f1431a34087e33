#include <fmt/format.h>

#include <limits>
#include <map>

#include "io/journal.hpp"
#include "io/trajectory_file.hpp"
#include "io/trajectory_items.hpp"
#include "suture/errors.hpp"
#include "suture/io/trajectory.hpp"

namespace suture {

struct TrajectoryWriter::Impl {
  std::filesystem::path path;
  std::optional<Journal> journal;  // none before the first commit
  std::string pending;             // items of the next block
  std::map<std::string, std::uint32_t> numbers;
  bool has_tissue = false;
  double last_time = -std::numeric_limits<double>::infinity();
  Tissue tissue;
  SharedValues reference_rest_length;
  bool closed = false;

  void add(TrajectoryItem item) {
    if (closed) throw FileError(fmt::format("{}: already closed", path.string()));
    pending += to_bytes(item);
  }

  void begin_frames(const TissueState& state) {
    has_tissue = true;
    tissue = state.tissue;
    reference_rest_length = state.reference_rest_length;
    add(TissueItem{tissue, reference_rest_length});
  }

  void expect_same_tissue(const TissueState& state) const {
    bool same =
        state.tissue.cell_count() == tissue.cell_count() && state.reference_rest_length == reference_rest_length;
    for (int cell = 0; same && cell < tissue.cell_count(); ++cell)
      same = state.tissue.vertex_count(cell) == tissue.vertex_count(cell);
    if (!same)
      throw FileError(fmt::format("{}: the frame at time {} belongs to another tissue than the frames before",
                                  path.string(), state.time));
  }

  std::uint32_t number_of(const Quantity& quantity) {
    const auto [entry, is_new] = numbers.try_emplace(quantity.name, static_cast<std::uint32_t>(numbers.size()));
    if (is_new) add(QuantityItem{entry->second, quantity});
    return entry->second;
  }

  // What the writer of an earlier process knew.
  void recall(const TissueItem& item) {
    has_tissue = true;
    tissue = item.tissue;
    reference_rest_length = item.reference_rest_length;
  }
  void recall(const FrameItem& item) { last_time = item.frame.time; }
  void recall(const QuantityItem& item) { numbers[item.quantity.name] = item.number; }
  template <class Other>
  void recall(const Other&) {}
};

std::filesystem::path journal_path(const std::filesystem::path& trajectory) {
  return std::filesystem::path(trajectory).replace_extension(".journal");
}

TrajectoryWriter::TrajectoryWriter() : impl_(std::make_unique<Impl>()) {}

TrajectoryWriter::TrajectoryWriter(std::filesystem::path path, const Provenance& provenance) : TrajectoryWriter() {
  impl_->path = std::move(path);
  impl_->add(make_header(provenance));
}

TrajectoryWriter TrajectoryWriter::resume(std::filesystem::path path, std::uint64_t length) {
  TrajectoryWriter writer;
  Impl& impl = *writer.impl_;
  impl.path = std::move(path);
  JournalReader reader(journal_path(impl.path));
  for (std::string block; reader.offset() < length && reader.next(block);) {
    ByteReader items(block);
    while (!items.at_end()) {
      TrajectoryItem item;
      items(item);
      std::visit([&impl](const auto& part) { impl.recall(part); }, item);
    }
  }
  if (reader.offset() != length)
    throw FileError(fmt::format("{}: ends or is damaged at byte {} of {}", journal_path(impl.path).string(),
                                reader.offset(), length));
  impl.journal = Journal::reopen(journal_path(impl.path), length);
  return writer;
}

TrajectoryWriter::TrajectoryWriter(TrajectoryWriter&&) noexcept = default;
TrajectoryWriter::~TrajectoryWriter() = default;

void TrajectoryWriter::write_stage(Stage stage, const TissueState& state) { impl_->add(StageItem{stage, state}); }

void TrajectoryWriter::write_frame(const TissueState& state, const FrameExtras& extras) {
  if (!(state.time > impl_->last_time))
    throw FileError(fmt::format("{}: a frame at time {} cannot follow one at {}", impl_->path.string(), state.time,
                                impl_->last_time));
  if (impl_->has_tissue)
    impl_->expect_same_tissue(state);
  else
    impl_->begin_frames(state);
  for ([[maybe_unused]] const CellField& field : extras.cell_fields)
    SUTURE_EXPECTS(field.values.size() == static_cast<std::size_t>(state.tissue.cell_count()));
  impl_->add(FrameItem{{state.time, state.purse_string, state.values, extras}});
  impl_->last_time = state.time;
}

void TrajectoryWriter::record(const Quantity& quantity, double time, double value) {
  impl_->add(ValueItem{impl_->number_of(quantity), time, value});
}

void TrajectoryWriter::record(const StoredEvent& event) { impl_->add(event); }
void TrajectoryWriter::record(const WoundSample& sample) { impl_->add(sample); }
void TrajectoryWriter::record(const Continuation& continuation) { impl_->add(continuation); }
void TrajectoryWriter::write_summary(const RunSummary& summary) { impl_->add(SummaryItem{to_json(summary), summary.solver}); }

void TrajectoryWriter::commit() {
  if (impl_->closed) throw FileError(fmt::format("{}: already closed", impl_->path.string()));
  if (impl_->pending.empty()) return;
  if (!impl_->journal) impl_->journal = Journal::create(journal_path(impl_->path));
  impl_->journal->append(impl_->pending);
  impl_->pending.clear();
}

void TrajectoryWriter::sync() {
  if (impl_->journal) impl_->journal->sync();
}

std::uint64_t TrajectoryWriter::length() const { return impl_->journal ? impl_->journal->size() : 0; }

void TrajectoryWriter::publish(bool complete) {
  commit();
  convert_journal(journal_path(impl_->path), impl_->path, complete);
}

void TrajectoryWriter::close() {
  publish(/*complete=*/true);
  discard_journal();
}

void TrajectoryWriter::discard_journal() {
  impl_->closed = true;
  std::error_code ignored;  // a journal that stays is no harm
  std::filesystem::remove(journal_path(impl_->path), ignored);
  impl_->journal.reset();
}

}  // namespace suture
