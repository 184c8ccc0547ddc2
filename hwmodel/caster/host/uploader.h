// The uploader keeps the ray caster's registers and memory up to date: after a step, only lines that changed
// are sent.
//
// The host compares lines with what it has sent. For levels and matter it looks at the bricks that the
// field's filter went through. Light, heights and texels have no such list, so it looks at all of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hwmodel/caster/host/upload.h"
#include "hwmodel/caster/model/stage.h"
#include "hwmodel/caster/model/upload_stage.h"
#include "kernel/automaton/state/grid.h"

namespace voxmelt::hwmodel::raycast {

enum class Sent : std::uint8_t { levels, matter, light, heights, texels };
inline constexpr std::size_t kSentVolumes = 5;

struct SentBrick {
  Sent volume = Sent::levels;
  state::Grid brick;
  bool other = false;  // a line of it was sent
  friend bool operator==(const SentBrick& a, const SentBrick& b) {
    return a.volume == b.volume && a.brick.x == b.brick.x && a.brick.y == b.brick.y && a.brick.z == b.brick.z;
  }
};

struct UploadReport {
  bool whole = false;                                         // everything was sent
  std::vector<SentBrick> bricks;                              // bricks that were looked at
  std::array<std::vector<std::int64_t>, kSentVolumes> lines;  // the caches must forget them
  std::array<std::int64_t, kSentVolumes> bytes{};
  // These count words of registers. A slot has 32 bits, and a word of the skip map has 16. A fine block of
  // ground has two words of 32 bits, a coarse one has one.
  std::int64_t slots = 0, skip_words = 0, ground_words = 0;
  std::int64_t words = 0, bursts = 0, cycles = 0;
  Account account;
};

// Describes a fault of an update, counted from 0. A brick is not sent, is sent to the place of the next one,
// or is sent while the caches are not told. Or matter keeps its table of bricks, and `brick` does not matter.
struct UploadFault {
  enum class Kind : std::uint8_t { forgotten, misplaced, untold, old_table };
  Kind kind = Kind::forgotten;
  std::int64_t update = 0;
  SentBrick brick;
};

class Uploader {
 public:
  explicit Uploader(const Configuration& configuration) : configuration_(configuration) {}

  // Takes over a picture's data. `changed` lists the bricks of the field that were filtered again since the
  // last call (DensityField::refreshed), or is null for all. Everything is sent if the grid or the size of
  // the picture is another one, or if there is no room for the bricks any more.
  UploadReport update(const render::PictureData& data, const std::vector<std::uint32_t>* changed);
  void plant(const UploadFault& fault) { fault_ = fault; }

  const Registers& registers() const { return registers_; }
  Memory& memory() { return memory_; }

 private:
  bool is_whole(const render::PictureData& data) const;
  std::vector<SentBrick> all_bricks(const render::PictureData& data) const;
  std::vector<SentBrick> due_bricks(const render::PictureData& data,
                                    const std::vector<std::uint32_t>& changed) const;
  bool strikes(UploadFault::Kind kind, const SentBrick& brick) const {
    return fault_ && fault_->kind == kind && fault_->update == updates_ && fault_->brick == brick;
  }
  void send_bricks(const render::PictureData& data, UploadReport& report);
  void send_lines(const render::PictureData& data, UploadReport& report);
  void send_registers(const render::PictureData& data, UploadReport& report);
  // Sends a line if it is another one in memory, and returns true if it did.
  bool send_other(const Layout& layout, Sent volume, std::int64_t line, const std::uint8_t* bytes,
                  UploadReport& report);

  Configuration configuration_;
  Registers registers_;
  Memory memory_;
  Upload upload_;
  std::int64_t room_ = 0;  // number of bricks that fit
  std::int64_t updates_ = 0;
  std::optional<UploadFault> fault_;
};

// Tells where registers and memory are not what a picture's data say, by places. The data may come from
// another object, which stores its bricks elsewhere.
struct UploadDifference {
  std::string volume;
  state::Grid brick, place;  // the brick of a sparse volume; the place, column or cell of light
  std::int64_t expected = 0, actual = 0;
};
struct UploadComparison {
  std::optional<UploadDifference> first;
  std::int64_t compared = 0;  // compared words
};
UploadComparison compare_upload(const Registers& registers, const Memory& memory,
                                const render::PictureData& data);
std::string text_of(const UploadDifference& difference, std::int64_t step);

}  // namespace voxmelt::hwmodel::raycast
