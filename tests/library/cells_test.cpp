// Pictures of cells are held against scenes whose cells, colours and pixels are worked by hand.
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "tests/library/scene_file.h"

namespace voxmelt {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

// The box has the cells 10..19, 3..12 and 8..11. Water fills 25..30, 3..10 and 7..12, and a pillar that never
// melts 34..37, 3..14 and 8..11. The floor is two cells deep.
const char* const kBoxes = R"(
[grid]
size = [40, 20, 24]
[[solid]]
shape = "box"
size = [10, 10, 4]
at = [15, 8, 10]
[[liquid]]
shape = "box"
size = [6, 8, 6]
at = [28, 7, 10]
[[inert]]
shape = "box"
size = [4, 12, 4]
at = [36, 9, 10]
[[inert]]
shape = "floor"
thickness = 2
)";

// The colours of the legend, and what is left of them on a face that looks along z: 224 of 256 parts.
constexpr Rgb kSolid{107, 118, 130}, kSolidAlongZ{93, 103, 113}, kLiquidAlongZ{173, 79, 37},
    kInertAlongZ{175, 157, 125}, kBehind{232, 236, 240};

class Cells : public SceneFile {
 protected:
  // Looks along an axis at the middle of the grid, in parallel. A pixel is an eighth of a cell, and the
  // picture is as high as the grid.
  static Picture parallel(Grid grid, double azimuth = 0, double elevation = 0) {
    Camera camera;
    camera.target = {grid.x / 2.0, grid.y / 2.0, grid.z / 2.0};
    camera.distance = grid.y / 2.0;
    camera.azimuth = azimuth;
    camera.elevation = elevation;
    camera.field_of_view = 90;
    camera.projection = Projection::orthographic;
    Picture picture;
    picture.camera = camera;
    picture.width = 8 * grid.x;
    picture.height = 8 * grid.y;
    picture.quality = Quality::fast;
    return picture;
  }
  // Returns the colour of the pixel that lies so many cells to the right, and from the top.
  static Rgb at(const Frame& frame, double right, double down) {
    const std::size_t place =
        static_cast<std::size_t>(8 * down) * frame.stride + 3 * static_cast<std::size_t>(8 * right);
    return {frame.rgb[place], frame.rgb[place + 1], frame.rgb[place + 2]};
  }
};

TEST_F(Cells, FacesHaveTheColoursOfTheirPhasesAndLookTheirWay) {
  Simulation simulation(write("boxes.toml", kBoxes));
  for (const Quality quality : {Quality::fast, Quality::normal, Quality::best}) {
    Picture picture = parallel(simulation.grid());
    picture.quality = quality;
    const Frame frame = simulation.render_cells({}, picture);
    EXPECT_EQ(frame.width, 320);
    EXPECT_EQ(frame.height, 160);
    EXPECT_EQ(at(frame, 15.5, 11.5), kSolidAlongZ);
    EXPECT_EQ(at(frame, 10.0, 7.0), kSolidAlongZ) << "its first pixel";
    EXPECT_EQ(at(frame, 9.9, 7.0), kBehind) << "the pixel before";
    EXPECT_EQ(at(frame, 10.0, 6.9), kBehind) << "the pixel above";
    EXPECT_EQ(at(frame, 28.5, 13.5), kLiquidAlongZ);
    EXPECT_EQ(at(frame, 36.5, 10.5), kInertAlongZ);
    EXPECT_EQ(at(frame, 5.5, 18.5), kInertAlongZ) << "the floor";
    EXPECT_EQ(at(frame, 5.5, 17.5), kBehind) << "above it";
  }
  // From its side, x, and from 45 degrees above.
  EXPECT_EQ(at(simulation.render_cells({}, parallel(simulation.grid(), -90)), 20 - 2, 11.5),
            (Rgb{83, 92, 101}));
  EXPECT_EQ(at(simulation.render_cells({}, parallel(simulation.grid(), 0, 89)), 15.5, 10 - 1.5), kSolid);
}

TEST_F(Cells, ACutShowsTheCellsBehindItInTheirOwnColours) {
  Simulation simulation(write("boxes.toml", kBoxes));
  const Picture front = parallel(simulation.grid()), back = parallel(simulation.grid(), 180);
  const CellView middle{CellColours::phase, CellCut{Axis::z, 10}},
      behind{CellColours::phase, CellCut{Axis::z, 8}};
  const Frame frame = simulation.render_cells(middle, front);
  EXPECT_EQ(at(frame, 15.5, 11.5), kSolid);
  EXPECT_EQ(at(frame, 28.5, 13.5), (Rgb{198, 91, 43}));
  EXPECT_EQ(at(frame, 5.5, 18.5), (Rgb{201, 180, 143}));
  const Frame gone = simulation.render_cells(behind, front);
  EXPECT_EQ(at(gone, 15.5, 11.5), kBehind) << "all of the box lies before the plane";
  EXPECT_EQ(at(gone, 28.5, 13.5), (Rgb{198, 91, 43})) << "one layer of water is left";

  const std::optional<Hit> hit = simulation.pick_cell(124, 92, middle, front);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->matter, (Cell{15, 8, 9}));
  EXPECT_EQ(hit->shown, Shown::solid);
  EXPECT_NEAR(hit->position[2], 10, 1e-5);
  EXPECT_EQ(hit->normal, (Position{0, 0, 1}));
  EXPECT_FALSE(simulation.pick_cell(124, 92, behind, front));
  const std::optional<Hit> other = simulation.pick_cell(320 - 124, 92, middle, back);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->matter, (Cell{15, 8, 10})) << "from behind, the other half is left";
}

TEST_F(Cells, WhatLiesBehindACutThroughAirIsNoCutFace) {
  Simulation simulation(write("boxes.toml", kBoxes));
  const Frame frame =
      simulation.render_cells({CellColours::phase, CellCut{Axis::z, 20}}, parallel(simulation.grid()));
  EXPECT_EQ(at(frame, 15, 12), kSolidAlongZ);
  EXPECT_EQ(at(frame, 28, 12), kLiquidAlongZ);
}

// Along every axis, and by perspective: the eye is 50 cells before the target.
TEST_F(Cells, CutsTakeAwayTheSideOfTheEye) {
  Simulation simulation(write("boxes.toml", kBoxes));
  Picture picture = parallel(simulation.grid());
  picture.camera->distance = 50;
  picture.camera->projection = Projection::perspective;
  picture.camera->target = {15.5, 8.5, 9.5};
  const auto seen = [&](double azimuth, double elevation, Axis axis, int at) {
    picture.camera->azimuth = azimuth;
    picture.camera->elevation = elevation;
    return simulation.pick_cell(160, 80, {CellColours::phase, CellCut{axis, at}}, picture)->matter;
  };
  EXPECT_EQ(seen(90, 0, Axis::x, 17), (Cell{16, 8, 9}));
  EXPECT_EQ(seen(-90, 0, Axis::x, 12), (Cell{12, 8, 9}));
  EXPECT_EQ(seen(0, 89, Axis::y, 10).y, 9);
  EXPECT_EQ(seen(0, -89, Axis::y, 4).y, 4);
  EXPECT_EQ(seen(0, 0, Axis::z, 11), (Cell{15, 8, 10}));
  EXPECT_EQ(seen(0, 0, Axis::z, 24), (Cell{15, 8, 11})) << "nothing is cut off";
  picture.camera->azimuth = -90;
  picture.camera->elevation = 0;
  EXPECT_EQ(simulation.pick_cell(160, 80, {CellColours::phase, std::nullopt}, picture)->matter,
            (Cell{10, 8, 9}))
      << "behind one brick of air";
}

// 0.45 lies 0.8 of the way from the scale's mark 0.25 to its mark 0.5.
TEST_F(Cells, TemperaturesAreColoursOfAScale) {
  Simulation simulation(file);
  const Frame frame =
      simulation.render_cells({CellColours::temperature, CellCut{Axis::z, 10}}, parallel(simulation.grid()));
  EXPECT_EQ(at(frame, 10.5, 6.5), (Rgb{188, 57, 130}));
  EXPECT_EQ(at(frame, 10.5, 11.5), (Rgb{170, 170, 170})) << "the floor has no temperature";
}

// A scene gives heat contents. One of 0.8 is a temperature of 0.6 if melting took up 0.2.
TEST_F(Cells, LatentHeatIsNoTemperature) {
  Simulation simulation(write("latent.toml", R"(
[grid]
size = [16, 8, 8]
[[liquid]]
shape = "box"
size = [8, 8, 8]
at = [8, 4, 4]
temperature = 0.8
[material]
melting_point = 0.5
latent_heat = 0.2
[heat]
gamma = 0.1
)"));
  ASSERT_EQ(simulation.state().heat.at(8, 4, 4), 52428);
  const Frame frame =
      simulation.render_cells({CellColours::temperature, CellCut{Axis::z, 4}}, parallel(simulation.grid()));
  EXPECT_EQ(at(frame, 8, 4), (Rgb{222, 102, 98}));
}

// A material of capacity 2 has half the temperature of its heat content. 0.2 lies 0.8 of the way from the
// scale's mark 0 to its mark 0.25. A wall keeps the temperature that its scene gives it.
TEST_F(Cells, MaterialsAndWallsHaveTheirOwnTemperatures) {
  Simulation simulation(write("materials.toml", R"(
[grid]
size = [24, 8, 8]
[material]
melting_point = 0.45
[[materials]]
name = "slow"
melting_point = 0.45
capacity = 2
[[solid]]
shape = "box"
size = [8, 8, 8]
at = [4, 4, 4]
temperature = 0.2
material = "slow"
[[solid]]
shape = "box"
size = [8, 8, 8]
at = [12, 4, 4]
temperature = 0.2
[[inert]]
shape = "box"
size = [8, 8, 8]
at = [20, 4, 4]
temperature = 0.45
[heat]
gamma = 0.1
)"));
  ASSERT_EQ(simulation.state().heat.at(4, 4, 4), 2 * simulation.state().heat.at(12, 4, 4));
  const Frame frame =
      simulation.render_cells({CellColours::temperature, CellCut{Axis::z, 4}}, parallel(simulation.grid()));
  EXPECT_EQ(at(frame, 4, 4), (Rgb{103, 4, 161}));
  EXPECT_EQ(at(frame, 12, 4), (Rgb{103, 4, 161}));
  EXPECT_EQ(at(frame, 20, 4), (Rgb{188, 57, 130}));
}

// A tile is 64 cells along x, 8 rows and a slice. A change wakes the tiles beside it, too.
TEST_F(Cells, WhatRestsSleepsUntilSomethingChangesBesideIt) {
  const std::filesystem::path scene = write("rest.toml", R"(
[grid]
size = [200, 40, 8]
[[solid]]
shape = "box"
size = [200, 40, 4]
at = [100, 20, 4]
)");
  constexpr Rgb kAsleep{70, 96, 150}, kAwake{240, 168, 40};
  const CellView view{CellColours::sleep, CellCut{Axis::z, 4}};
  Simulation simulation(scene);
  const Picture picture = parallel(simulation.grid());
  const auto shown = [&](double right, double down) {
    return at(simulation.render_cells(view, picture), right, down);
  };
  EXPECT_EQ(shown(10, 20), kAwake) << "nothing is known of the first state";
  simulation.step(2);
  EXPECT_EQ(shown(10, 20), kAsleep);
  EXPECT_EQ(shown(190, 39), kAsleep);
  simulation.carve({5, 36, 4.5}, 1);  // rows 32..39 of the first 64 columns, in slice 4
  EXPECT_EQ(shown(20, 4), kAwake);
  EXPECT_EQ(shown(127.5, 15.5), kAwake) << "the tiles beside it, in slice 3";
  EXPECT_EQ(shown(128.5, 15.5), kAsleep);
  EXPECT_EQ(shown(127.5, 16.5), kAsleep);

  Simulation plain(scene, {{}, "reference"});
  plain.step(2);
  EXPECT_EQ(at(plain.render_cells(view, picture), 10, 20), kAwake) << "nothing sleeps in the reference";
}

TEST_F(Cells, WrongViewsAreRefused) {
  Simulation simulation(write("boxes.toml", kBoxes));
  const auto refused = [&](const CellView& view, const Picture& picture = {}) {
    const std::string drawn = message_of<InputError>([&] { simulation.render_cells(view, picture); });
    EXPECT_EQ(drawn, message_of<InputError>([&] { simulation.pick_cell(0, 0, view, picture); }));
    return drawn;
  };
  EXPECT_EQ(refused({CellColours::phase, CellCut{Axis::x, 41}}),
            "CellView: error: cut.at = 41 is outside 0..40");
  EXPECT_EQ(refused({CellColours::phase, CellCut{Axis::y, -1}}),
            "CellView: error: cut.at = -1 is outside 0..20");
  EXPECT_EQ(refused({CellColours::temperature, {}}),
            "CellView: error: colours = temperature: the scene has no [heat]");
  Picture small;
  small.width = 3;
  EXPECT_EQ(refused({}, small), "Picture: error: width = 3 is outside 16..16384");
  EXPECT_EQ(message_of<InputError>([&] { simulation.pick_cell(-1, 0); }).substr(0, 23),
            "pick: error: x = -1 is ");
  EXPECT_EQ(legend(CellColours::sleep)[1].name, "awake");
}

}  // namespace
}  // namespace voxmelt
