/// @file
/// voxmelt: solid voxel models melt and flow, by the 3D cellular automaton of X. Wei, W. Li and A. Kaufman,
/// "Melting and Flowing of Viscous Volumes", CASA 2003. docs/automaton.md defines every bit of it.
///
///     voxmelt::Simulation cello("scenes/cello.toml");
///     cello.step(500);
///     cello.draw("cello.png");
///
/// These headers need the standard library of C++20 only. With CMake: find_package(voxmelt), and
/// link voxmelt::voxmelt.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "voxmelt/changes.h"
#include "voxmelt/errors.h"
#include "voxmelt/ledgers.h"
#include "voxmelt/picture.h"
#include "voxmelt/sources.h"
#include "voxmelt/state.h"

/// Everything that voxmelt offers to other programs.
namespace voxmelt {

/// Version of this library, "MAJOR.MINOR.PATCH".
std::string version();

/// A program that executes the automaton. All of them give the same bits.
struct Implementation {
  std::string name;         ///< "reference", "avx2", ...
  std::string description;  ///< one line
  bool supported = true;    ///< by this processor
};

/// All implementations of this build, the reference first.
std::vector<Implementation> implementations();

/// How a scene is opened.
struct Options {
  /// "path.to.key=value" each, as with --set: they are applied in order and checked like the file. A
  /// checkpoint takes none.
  std::vector<std::string> overrides;
  /// A name from implementations(), or "auto" for the fastest one that this processor supports.
  std::string implementation = "auto";
  /// 1..1024, or 0 for as many as the machine has. No result depends on it.
  int threads = 0;
};

/// A format of an exported state.
struct Format {
  std::string name;         ///< "npy", "vti", ...
  std::string description;  ///< a few words
};

/// All formats of this build. The first one, "npy", is what a scene can start from (key `start.fields`).
std::vector<Format> formats();

/// Is told after each step of a call of step(): how many are done, and of how many. The simulation is between
/// two steps then, so it may be looked at, drawn and saved, but not stepped.
using Progress = std::function<void(std::uint32_t done, std::uint32_t count)>;

/// The keys that Simulation::set() takes (docs/library.md).
std::vector<std::string> changeable_keys();

/// A scene that melts and flows, step by step.
///
/// Only one thread at a time may use a simulation. Several simulations may run at a time. A moved-from
/// simulation can only be assigned to or destroyed. If step() throws ResourceError, the state is in the
/// middle of a step: only restart() brings it back.
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

  /// One line that says what the scene is.
  const std::string& title() const;
  /// What is odd about the scene but no error, one line each: faults of a mesh, fields without effect.
  const std::vector<std::string>& warnings() const;
  /// Number of steps that the scene suggests, for callers with no number of their own.
  std::uint32_t scene_steps() const;
  /// Name of the implementation in use.
  const std::string& implementation() const;
  /// Number of threads in use: at most as many as the machine has.
  int threads() const;

  /// Runs whole steps (docs/automaton.md, section 3). It ends early, between two steps, once `stop` is
  /// requested, which any thread may do. What `progress` throws comes through.
  /// @return the number of steps that were run
  /// @throws InputError where step numbers would exceed 2^32 - 1
  /// @throws ResourceError when memory runs out
  std::uint32_t step(std::uint32_t count = 1, const std::stop_token& stop = {},
                     const Progress& progress = {});
  /// Goes back to the state with which this simulation began. Its file is read again. What was set since then
  /// stays: parameters, sources, vents and drains.
  /// @throws InputError where the file no longer gives that state; then nothing has changed
  /// @throws ResourceError when memory runs out; then nothing has changed
  void restart();
  /// Steps run so far.
  std::uint32_t steps_done() const;
  /// The automaton's number of the next step: steps_done(), plus the scene's `start.step`.
  std::uint32_t step_number() const;

  /// Size of the volume in cells.
  Grid grid() const;
  /// The present state, to be read in place.
  State state() const;
  /// 64 bits that stand for the whole state (docs/automaton.md, section 13): equal digests, equal bits.
  std::uint64_t digest() const;
  /// The books up to now. This takes a pass over the state.
  Ledgers ledgers() const;
  /// The bricks that may have changed since `version`, which an earlier call gave; 0 stands for no call.
  /// After restart() all have.
  Changes changes(std::uint64_t version = 0);

  /// Gives a number of the scene another value, from the next step on; `heat.rays_per_face` counts from the
  /// next step of visibility on. The bits are those of a scene that begins from the present state and has
  /// this value. docs/library.md lists the keys.
  /// @throws InputError for another key, and for a value out of its range; then nothing changes
  void set(const std::string& key, double value);

  /// The sources, vents and drains, as rounded to the automaton's units.
  std::vector<HeatSource> heat_sources() const;
  std::vector<Vent> vents() const;    ///< @copydoc heat_sources
  std::vector<Drain> drains() const;  ///< @copydoc heat_sources

  /// Other heat sources. They take effect at the next step whose number is divisible by the scene's
  /// `heat.visibility_every`: the automaton computes shadows only at those steps (section 5).
  /// @throws InputError for numbers out of their range, and in a scene without [heat]; then nothing changes
  void set_heat_sources(const std::vector<HeatSource>& sources);
  /// Other vents, from the next step on.
  /// @throws InputError for numbers out of their range; nothing is changed then
  void set_vents(const std::vector<Vent>& vents);
  /// Other drains, from the next step on.
  /// @throws InputError for numbers out of their range; nothing is changed then
  void set_drains(const std::vector<Drain>& drains);

  /// Writes the state and parameters.json into a folder. The folder is made, or replaced whole if it holds
  /// nothing but an earlier export; it is never half-written. `format` is a name from formats().
  /// @throws InputError for an unknown format
  /// @throws OutputError where that cannot be done
  /// @throws ResourceError when the disk is full
  void export_state(const std::filesystem::path& folder, const std::string& format = "npy") const;

  /// Writes a checkpoint (docs/checkpoint.md): Simulation(file) goes on from it, and so do all commands that
  /// take a scene. The file is replaced whole.
  /// @throws OutputError where it cannot be written
  /// @throws ResourceError when the disk is full
  void save(const std::filesystem::path& file) const;

  /// The camera of a picture, with its distance where the scene leaves that open.
  /// @throws InputError for numbers out of their range
  Camera camera(const Picture& picture = {}) const;
  /// Draws the state, with the scene's light and look. The first picture takes longer; later ones update what
  /// has changed.
  /// @throws InputError for numbers out of their range
  /// @throws Stopped once `stop` is requested
  /// @throws ResourceError when memory runs out
  Frame render(const Picture& picture = {}, const std::stop_token& stop = {});
  /// What the middle of pixel (x, y) shows, counted from the upper left; nothing where it is the background.
  /// It takes a fraction of a millisecond, once the state is drawn.
  /// @throws InputError for numbers out of their range, and for a pixel beyond the picture
  /// @throws ResourceError when memory runs out
  std::optional<Hit> pick(int x, int y, const Picture& picture = {});
  /// Draws the state into a PNG file: the bytes of render().
  /// @throws InputError for numbers out of their range
  /// @throws OutputError where the file cannot be written
  /// @throws ResourceError when memory or disk space is used up
  void draw(const std::filesystem::path& file, const Picture& picture = {});

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace voxmelt
