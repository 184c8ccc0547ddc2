/// @file
/// voxmelt lets solid voxel models melt and flow, by the 3D cellular automaton of X. Wei, W. Li and A.
/// Kaufman, "Melting and Flowing of Viscous Volumes", CASA 2003. docs/automaton.md defines every bit of it.
///
///     voxmelt::Simulation cello("scenes/cello.toml");
///     cello.step(500);
///     cello.draw("cello.png");
///
/// These headers need the standard library of C++20 only. With CMake, call find_package(voxmelt) and link
/// voxmelt::voxmelt.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "voxmelt/cells.h"
#include "voxmelt/changes.h"
#include "voxmelt/errors.h"
#include "voxmelt/ledgers.h"
#include "voxmelt/picture.h"
#include "voxmelt/sources.h"
#include "voxmelt/state.h"
#include "voxmelt/textures.h"

/// This namespace has everything that voxmelt offers to other programs.
namespace voxmelt {

/// Returns the version of this library, "MAJOR.MINOR.PATCH".
std::string version();

/// Describes a program that executes the automaton. All of them give the same bits.
struct Implementation {
  std::string name;         ///< "reference", "avx2", ...
  std::string description;  ///< one line
  bool supported = true;    ///< this processor can run it
};

/// Lists all implementations of this build, the reference first.
std::vector<Implementation> implementations();

/// Lists the devices of this machine, such as graphics cards: "gpu:0", "gpu:1", ... Drivers are looked for in
/// the first call, which may take a moment. "auto" takes none of them.
std::vector<Implementation> devices();

/// Tells how a scene is opened.
struct Options {
  /// Holds one "path.to.key=value" each, as with --set. They are applied in order and checked like the file.
  /// A checkpoint takes none.
  std::vector<std::string> overrides;
  /// Is a name from implementations() or devices(), or "auto" for the fastest one that this processor
  /// supports.
  std::string implementation = "auto";
  /// Is 1..1024, or 0 for as many as the machine has. No result depends on it.
  int threads = 0;
};

/// Describes a format of an exported state.
struct Format {
  std::string name;         ///< "npy", "vti", ...
  std::string description;  ///< a few words
};

/// Lists all formats of this build. A scene can start from the first one, "npy" (key `start.fields`).
std::vector<Format> formats();

/// Is told after each step of a call of step() how many are done, and of how many. The simulation is between
/// two steps then. So it may be looked at, drawn and saved, but not stepped.
using Progress = std::function<void(std::uint32_t done, std::uint32_t count)>;

/// Says what happens between two steps, in the words of `[[change]]` of a scene file (docs/scenes.md).
struct SceneChange {
  std::uint32_t steps_done = 0;  ///< how many steps are done before it
  std::string what;              ///< "vent.0.rate 0.2", "carve 10 10 10 4", ...
};

/// Returns the text of a scene that makes these changes, too: before its own ones of the same step.
/// @throws InputError for a text that is no scene's
std::string with_changes(const std::string& scene_text, const std::vector<SceneChange>& more);

/// Lists the keys that Simulation::set() takes (docs/library.md).
std::vector<std::string> changeable_keys();

/// Runs a scene that melts and flows, step by step.
///
/// Only one thread at a time may use a simulation. Several simulations may run at a time. A moved-from
/// simulation can only be assigned to or destroyed. If step() throws ResourceError, the state is in the
/// middle of a step, and only restart() brings it back.
class Simulation {
 public:
  /// Reads a scene file (docs/scenes.md) and builds its first state, or goes on from a checkpoint that save()
  /// or `voxmelt run` wrote.
  /// @throws InputError for a file or an override that is wrong, and for options out of their range
  /// @throws ResourceError when the grid does not fit into memory
  explicit Simulation(const std::filesystem::path& scene, const Options& options = {});
  Simulation(Simulation&&) noexcept;             ///< takes over
  Simulation& operator=(Simulation&&) noexcept;  ///< takes over
  ~Simulation();

  /// Returns one line that describes the scene.
  const std::string& title() const;
  /// Lists the oddities of the scene that are no errors, one line each: faults of a mesh, fields without
  /// effect.
  const std::vector<std::string>& warnings() const;
  /// Returns the number of steps that the scene suggests, for callers with no number of their own.
  std::uint32_t scene_steps() const;
  /// Returns the name of the implementation in use.
  const std::string& implementation() const;
  /// Returns the number of threads in use, at most as many as the machine has.
  int threads() const;

  /// Runs whole steps (docs/automaton.md, section 3). Changes of the scene, `[[change]]`, are made before
  /// those steps that they name. It ends early, between two steps, once `stop` is
  /// requested, which any thread may do. An exception from `progress` comes through.
  /// @return the number of steps that were run
  /// @throws InputError where step numbers would exceed 2^32 - 1, and for a change that cannot be made
  /// @throws ResourceError when memory runs out
  std::uint32_t step(std::uint32_t count = 1, const std::stop_token& stop = {},
                     const Progress& progress = {});
  /// Goes back to the state with which this simulation began. Its file is read again. Parameters, sources,
  /// vents and drains that were set since then stay. Only a scene with `[[change]]` has its own ones again.
  /// @throws InputError where the file no longer gives that state; then nothing has changed
  /// @throws ResourceError when memory runs out; then nothing has changed
  void restart();
  /// Returns the number of steps run so far.
  std::uint32_t steps_done() const;
  /// Returns the automaton's number of the next step: steps_done(), plus the scene's `start.step`.
  std::uint32_t step_number() const;

  /// Returns the scene as one text (TOML): all that its file and the overrides said, with whole paths of
  /// other files. It is empty for a simulation that began from a checkpoint.
  const std::string& scene_text() const;

  /// Returns the size of the volume in cells.
  Grid grid() const;
  /// Returns the present state, to be read in place.
  State state() const;
  /// Returns 64 bits that stand for the whole state (docs/automaton.md, section 13). Equal bits have equal
  /// digests.
  std::uint64_t digest() const;
  /// Returns the books up to now. This takes a pass over the state.
  Ledgers ledgers() const;
  /// Counts the solid cells of pieces that nothing holds (docs/automaton.md, section 15), in any scene. They
  /// fall or float where the scene says `[pieces]`. This takes a pass over the state.
  std::int64_t loose_cells() const;
  /// Lists the bricks that may have changed since `version`, which an earlier call gave. Use 0 if there was
  /// no call. After restart() all bricks count as changed.
  Changes changes(std::uint64_t version = 0);

  /// Gives a number of the scene another value, from the next step on. `heat.rays_per_face` counts from the
  /// next step of visibility on. The bits are those of a scene that begins from the present state and has
  /// this value. docs/library.md lists the keys.
  /// @throws InputError for another key, and for a value out of its range; then nothing changes
  void set(const std::string& key, double value);

  /// Returns the numbers that set() takes and the scene says, by their keys. Others have the defaults that
  /// docs/scenes.md lists.
  std::map<std::string, double> numbers() const;

  /// Returns the sources, vents or drains, as rounded to the automaton's units.
  std::vector<HeatSource> heat_sources() const;
  std::vector<Vent> vents() const;    ///< @copydoc heat_sources
  std::vector<Drain> drains() const;  ///< @copydoc heat_sources

  /// Sets other heat sources. They take effect at the next step whose number is divisible by the scene's
  /// `heat.visibility_every`. The automaton computes shadows only at those steps (section 5).
  /// @throws InputError for numbers out of their range, and in a scene without [heat]; then nothing changes
  void set_heat_sources(const std::vector<HeatSource>& sources);
  /// Sets other vents, from the next step on.
  /// @throws InputError for numbers out of their range; nothing is changed then
  void set_vents(const std::vector<Vent>& vents);
  /// Sets other drains, from the next step on.
  /// @throws InputError for numbers out of their range; nothing is changed then
  void set_drains(const std::vector<Drain>& drains);

  /// Pours liquid into a ball, at once: each cell of air whose centre is in it gets as much as a full cell
  /// holds, of this temperature. Other cells stay. The ledgers book it as what vents add (docs/automaton.md,
  /// section 16).
  /// @param at centre of the ball, in cells
  /// @param radius more than 0, at most 8192
  /// @param temperature 0..1; unused in a scene without [heat]
  /// @throws InputError for numbers out of their range, and for a ball outside the grid; nothing changes then
  void pour(const Position& at, double radius, double temperature);
  /// Takes solid and liquid out of a ball, at once: out of each cell whose centre is in it. Inert cells stay.
  /// The ledgers book it as what drains take. Numbers are those of pour().
  /// @throws InputError for numbers out of their range, and for a ball outside the grid; nothing changes then
  void carve(const Position& at, double radius);

  /// Writes the state and parameters.json into a folder. The folder is made, or replaced whole if it holds
  /// nothing but an earlier export. It is never half-written. `format` is a name from formats().
  /// @throws InputError for an unknown format
  /// @throws OutputError where that cannot be done
  /// @throws ResourceError when the disk is full
  void export_state(const std::filesystem::path& folder, const std::string& format = "npy") const;

  /// Writes a checkpoint (docs/checkpoint.md). Simulation(file) goes on from it, and so do all commands that
  /// take a scene. The file is replaced whole.
  /// @throws OutputError where it cannot be written
  /// @throws ResourceError when the disk is full
  void save(const std::filesystem::path& file) const;

  /// Returns the camera of a picture, with its distance filled in if the scene leaves that open.
  /// @throws InputError for numbers out of their range
  Camera camera(const Picture& picture = {}) const;
  /// Draws the state, with the scene's light and look. The first picture takes longer. Later ones update only
  /// what has changed.
  /// @throws InputError for numbers out of their range
  /// @throws Stopped once `stop` is requested
  /// @throws ResourceError when memory runs out
  Frame render(const Picture& picture = {}, const std::stop_token& stop = {});
  /// Tells what the middle of pixel (x, y) shows, counted from the upper left. It returns nothing for the
  /// background. It takes a fraction of a millisecond, once the state is drawn.
  /// @throws InputError for numbers out of their range, and for a pixel beyond the picture
  /// @throws ResourceError when memory runs out
  std::optional<Hit> pick(int x, int y, const Picture& picture = {});
  /// Draws the cells as boxes in false colours, with the camera of a picture and a plain background. There
  /// are one, 2 x 2 or 4 x 4 samples in each pixel, by the picture's quality, and no depths.
  /// @throws InputError for numbers out of their range, and for temperatures in a scene without [heat]
  /// @throws ResourceError when memory runs out
  Frame render_cells(const CellView& view = {}, const Picture& picture = {});
  /// Tells which cell of render_cells() the middle of pixel (x, y) shows. The hit lies on a face of it.
  /// @throws InputError for numbers out of their range, and for a pixel beyond the picture
  std::optional<Hit> pick_cell(int x, int y, const CellView& view = {}, const Picture& picture = {});
  /// Returns everything that a picture of the state is drawn from, for programs that draw by a graphics
  /// processor. Only those bricks are listed that have changed since `version`, which an earlier call gave.
  /// Use 0 if there was no call. Bytes are valid until the next call that is not const.
  /// @throws InputError for grids of more than 1024 cells along a side, or 2^25 in all
  /// @throws ResourceError when memory runs out
  Textures textures(std::uint64_t version = 0);
  /// Draws the state into a PNG file, with the bytes of render().
  /// @throws InputError for numbers out of their range
  /// @throws OutputError where the file cannot be written
  /// @throws ResourceError when memory or disk space is used up
  void draw(const std::filesystem::path& file, const Picture& picture = {});

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace voxmelt
