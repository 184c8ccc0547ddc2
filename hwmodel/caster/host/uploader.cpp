#include "hwmodel/caster/host/uploader.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

#include "hwmodel/caster/host/memory_image.h"
#include "kernel/automaton/state/changed_bricks.h"

namespace voxmelt::hwmodel::raycast {
namespace {

state::Grid field_bricks(const render::FieldData& field) {
  const auto side = [](std::int64_t cells) { return static_cast<int>(cells); };
  return state::brick_grid({side(field.cells.x), side(field.cells.y), side(field.cells.z)});
}

template <class Visit>
void for_all(const state::Grid& grid, const Visit& visit) {
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x) visit(state::Grid{x, y, z});
}

}  // namespace

UploadReport Uploader::update(const render::PictureData& data, const std::vector<std::uint32_t>* changed) {
  UploadReport report;
  report.whole = changed == nullptr || is_whole(data);
  upload_ = {};
  if (report.whole) {
    const std::int64_t stored = stored_bricks(data.field);
    room_ = stored + stored / 4 + 16;
    memory_ = room_for(data, configuration_, room_);
    report.bricks = all_bricks(data);
  } else {
    report.bricks = due_bricks(data, *changed);
  }
  send_registers(data, report);
  std::erase_if(report.bricks,
                [&](const SentBrick& brick) { return strikes(UploadFault::Kind::forgotten, brick); });
  send_bricks(data, report);
  send_lines(data, report);
  const UploadEnd end = run_upload(upload_, memory_, configuration_);
  report.words = upload_.words;
  report.bursts = upload_.bursts();
  report.cycles = end.cycles;
  report.account = end.account;
  ++updates_;
  return report;
}

bool Uploader::is_whole(const render::PictureData& data) const {
  return stored_bricks(data.field) > room_ || registers_.cells.x != data.field.cells.x ||
         registers_.cells.y != data.field.cells.y || registers_.cells.z != data.field.cells.z ||
         registers_.camera.width != data.width || registers_.camera.height != data.height;
}

std::vector<SentBrick> Uploader::all_bricks(const render::PictureData& data) const {
  std::vector<SentBrick> all;
  for_all(lattice_bricks(data.field), [&](const state::Grid& b) {
    if (memory_.levels.brick_at(b.x, b.y, b.z) == 0) return;
    all.push_back({Sent::levels, b});
    all.push_back({Sent::matter, b});
  });
  return all;
}

// Cells 8 f .. 8 f + 7 of the field change levels and matter of the cells 8 f - 1 .. 8 f + 8, by the
// pre-filter. These are the places 8 f + 1 .. 8 f + 10 of the lattice, in its bricks f and f + 1; brick f - 1
// has the first of them in its apron. Today's filter reaches a cell at least, so that its list holds the
// bricks that only `before` and `moved` add; nothing here relies on that.
std::vector<SentBrick> Uploader::due_bricks(const render::PictureData& data,
                                            const std::vector<std::uint32_t>& changed) const {
  const state::Grid from = field_bricks(data.field), to = lattice_bricks(data.field);
  const int before = configuration_.apron ? 1 : 0;
  std::vector<std::uint8_t> levels(to.cells()), matter(to.cells());
  const auto mark = [&](const state::Grid& f, int low, std::vector<std::uint8_t>& due) {
    for (int z = std::max(f.z - low, 0); z <= std::min(f.z + 1, to.z - 1); ++z)
      for (int y = std::max(f.y - low, 0); y <= std::min(f.y + 1, to.y - 1); ++y)
        for (int x = std::max(f.x - low, 0); x <= std::min(f.x + 1, to.x - 1); ++x)
          due[to.index(x, y, z)] = 1;
  };
  for (const std::uint32_t brick : changed) {
    const int i = brick;
    const state::Grid f{i % from.x, i / from.x % from.y, i / from.x / from.y};
    mark(f, before, levels);
    mark(f, 0, matter);
  }
  std::vector<SentBrick> all;
  for_all(to, [&](const state::Grid& b) {
    const std::size_t i = to.index(b.x, b.y, b.z);
    const std::int32_t slot = data.field.slots[i];
    if (slot == 0) return;
    const bool moved = slot != memory_.levels.slots[i];
    if (moved || levels[i] != 0) all.push_back({Sent::levels, b});
    if (moved || matter[i] != 0) all.push_back({Sent::matter, b});
  });
  return all;
}

void Uploader::send_registers(const render::PictureData& data, UploadReport& report) {
  Registers next = registers_of(data);
  const auto differing = [&](const auto& words, const auto& before) {
    std::int64_t count = 0;
    for (std::size_t i = 0; i < words.size(); ++i)
      count += report.whole || i >= before.size() || words[i] != before[i] ? 1 : 0;
    return count;
  };
  report.skip_words = differing(next.skip.words, registers_.skip.words);
  report.ground_words = 2 * differing(next.ground.blocks.fine, registers_.ground.blocks.fine) +
                        differing(next.ground.blocks.coarse, registers_.ground.blocks.coarse);
  registers_ = std::move(next);
  const std::vector<std::int32_t> slots(data.field.slots, data.field.slots + memory_.levels.slots.size());
  report.slots = differing(slots, memory_.levels.slots);
  memory_.levels.slots = slots;
  const bool keeps = fault_ && fault_->kind == UploadFault::Kind::old_table && fault_->update == updates_;
  if (!keeps) memory_.matter.slots = slots;
  upload_.words = report.slots + report.skip_words + report.ground_words;
}

void Uploader::send_bricks(const render::PictureData& data, UploadReport& report) {
  for (SentBrick& brick : report.bricks) {
    const Layout& layout = brick.volume == Sent::levels ? memory_.levels : memory_.matter;
    std::vector<std::int64_t>& told = report.lines[static_cast<std::size_t>(brick.volume)];
    const std::size_t sent_before = upload_.addresses.size(), told_before = told.size();
    const LineSink sink = [&](std::int64_t line, const std::uint8_t* bytes) {
      brick.other = send_other(layout, brick.volume, line, bytes, report) || brick.other;
    };
    (brick.volume == Sent::levels ? level_lines : matter_lines)(data, layout, brick.brick, sink);
    if (strikes(UploadFault::Kind::misplaced, brick))
      for (std::size_t i = sent_before; i < upload_.addresses.size(); ++i)
        upload_.addresses[i] += std::int64_t{layout.line_bytes} << (3 * (kBrickBits - layout.bits[0]));
    if (strikes(UploadFault::Kind::untold, brick)) told.resize(told_before);
  }
}

void Uploader::send_lines(const render::PictureData& data, UploadReport& report) {
  const auto into = [&](const Layout& layout, Sent volume) -> LineSink {
    return [&, volume](std::int64_t line, const std::uint8_t* bytes) {
      send_other(layout, volume, line, bytes, report);
    };
  };
  light_lines(data, memory_.light, into(memory_.light, Sent::light));
  height_lines(data, memory_.heights, into(memory_.heights, Sent::heights));
  texel_lines(data, memory_.texels, into(memory_.texels, Sent::texels));
}

bool Uploader::send_other(const Layout& layout, Sent volume, std::int64_t line, const std::uint8_t* bytes,
                          UploadReport& report) {
  const auto one = static_cast<std::size_t>(volume);
  if (!report.whole &&
      std::memcmp(memory_.bytes.data() + layout.address(line), bytes, layout.line_bytes) == 0)
    return false;
  upload_.add(layout.address(line), bytes, layout.line_bytes);
  report.lines[one].push_back(line);
  report.bytes[one] += layout.line_bytes;
  return true;
}

}  // namespace voxmelt::hwmodel::raycast
