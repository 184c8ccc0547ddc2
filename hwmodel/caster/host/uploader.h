// Keeps the ray caster's registers and memory up to date: after a step, only lines that changed are sent.
//
// The host compares lines with what it has sent. Of levels and matter it looks at the bricks that the field's
// filter went through; light, heights and texels have no such list, and it looks at all of them.
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
  std::vector<SentBrick> bricks;                              // that were looked at
  std::array<std::vector<std::int64_t>, kSentVolumes> lines;  // caches must forget them
  std::array<std::int64_t, kSentVolumes> bytes{};
  // Register words: 32 bits, 16 bits; a block of ground has two of 32.
  std::int64_t slots = 0, skip_words = 0, ground_words = 0;
  std::int64_t words = 0, bursts = 0, cycles = 0;
  Account account;
};

// A fault of an update, counted from 0: a brick is not sent, is sent to the place of the next one, or is sent
// and the caches are not told; or matter keeps its table of bricks, and `brick` does not matter.
struct UploadFault {
  enum class Kind : std::uint8_t { forgotten, misplaced, untold, old_table };
  Kind kind = Kind::forgotten;
  std::int64_t update = 0;
  SentBrick brick;
};

class Uploader {
 public:
  explicit Uploader(const Configuration& configuration) : configuration_(configuration) {}

  // Takes over a picture's data. `changed`: bricks of the field that were filtered again since the last call
  // (DensityField::refreshed), or null for all. Another grid or size of picture, and bricks for which there
  // is no room any more, make it send everything.
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
  // Sends a line that is another one in memory. Tells whether it did.
  bool send_other(const Layout& layout, Sent volume, std::int64_t line, const std::uint8_t* bytes,
                  UploadReport& report);

  Configuration configuration_;
  Registers registers_;
  Memory memory_;
  Upload upload_;
  std::int64_t room_ = 0;  // for so many bricks
  std::int64_t updates_ = 0;
  std::optional<UploadFault> fault_;
};

// Where registers and memory are not what a picture's data say, by places: the data may come from another
// object, which stores its bricks elsewhere.
struct UploadDifference {
  std::string volume;
  state::Grid brick, place;  // the brick of a sparse volume; the place, column or cell of light
  std::int64_t expected = 0, actual = 0;
};
struct UploadComparison {
  std::optional<UploadDifference> first;
  std::int64_t compared = 0;  // words
};
UploadComparison compare_upload(const Registers& registers, const Memory& memory,
                                const render::PictureData& data);
std::string text_of(const UploadDifference& difference, std::int64_t step);

}  // namespace voxmelt::hwmodel::raycast
