// Everything that a picture is drawn from is kept as textures, for a graphics processor that draws by the
// same rules (docs/picture/definition.md). Only its bricks that change have to be uploaded again.
//
// | texture | texel |
// |---|---|
// | levels | level + 32640 of a place of the lattice (definition.md, section 12), so air is 0 |
// | matter | liquid, heat or tone, obstacle and 0 of the place |
// | blocks | of 4 x 4 x 4 places: blocks to the nearest with matter, or 256 + a bound of the slope in it |
// | light | bytes of a cell of light, in the order of LightBytes |
// | columns | bare and drawn height of a column of the grid |
// | rock | texel of the ground's top, in the order of GroundData |
// | tables | all tables of the paint, one behind the other |
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "render/packet/picture_data.h"
#include "render/textures/bricked_texture.h"

namespace voxmelt::render {

// Holds a number of the picture by name, or several.
struct PictureNumbers {
  std::string_view name;
  std::vector<std::int32_t> values;
};

class PictureTextures {
 public:
  // Takes over what a picture is drawn from. The view does not count.
  void update(const PictureData& data);

  // Returns the number of the newest change. No other object gives the same one.
  std::uint64_t version() const { return version_; }
  // Tells whether that version belongs to these textures, so that bricks may be counted from it.
  bool knows(std::uint64_t version) const { return version >= first_ && version <= version_; }

  const std::vector<BrickedTexture>& all() const { return all_; }
  const std::vector<PictureNumbers>& numbers() const { return numbers_; }

 private:
  enum Which : std::uint8_t { kLevels, kMatter, kBlocks, kLight, kColumns, kRock, kTables };

  void begin(const PictureData& data);
  bool take_field(const FieldData& field, std::uint64_t version);
  bool take_blocks(const FieldData& field, std::uint64_t version);
  bool take_ground(const GroundData& ground, std::uint64_t version);
  bool take_tables(const PictureData& data, std::uint64_t version);

  std::uint64_t version_ = 0, first_ = 1;
  std::vector<std::int32_t> shape_;  // sizes for which the textures were made
  std::vector<BrickedTexture> all_;
  std::vector<PictureNumbers> numbers_;
  std::vector<std::int32_t> tables_;
};

}  // namespace voxmelt::render
