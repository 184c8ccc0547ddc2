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
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "voxmelt/errors.h"
#include "voxmelt/ledgers.h"
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
  /// "path.to.key=value" each, as with --set: they are applied in order and checked like the file.
  std::vector<std::string> overrides;
  /// A name from implementations(), or "auto" for the fastest one that this processor supports.
  std::string implementation = "auto";
  /// 1..1024, or 0 for as many as the machine has. No result depends on it.
  int threads = 0;
};

/// How carefully a picture is drawn.
enum class Quality {
  fast,    ///< one sample per pixel
  normal,  ///< eight where a pixel differs from a neighbour
  best,    ///< thirty-two where it differs, along shorter steps
};

/// A picture of a state. What is not set here is taken from the scene.
struct Picture {
  std::optional<int> width;           ///< pixels, 16..8192
  std::optional<int> height;          ///< pixels, 16..8192
  std::optional<double> azimuth;      ///< degrees around the vertical, -360..360; 0 from the front
  std::optional<double> elevation;    ///< degrees above the horizon, -89..89
  Quality quality = Quality::normal;  ///< how carefully it is drawn
};

/// A format of an exported state.
struct Format {
  std::string name;         ///< "npy", "vti", ...
  std::string description;  ///< a few words
};

/// All formats of this build. The first one, "npy", is what a scene can start from (key `start.fields`).
std::vector<Format> formats();

/// A scene that melts and flows, step by step.
///
/// Only one thread at a time may use a simulation. Several simulations may run at a time. A moved-from
/// simulation can only be assigned to or destroyed. If step() throws ResourceError, the state is in the
/// middle of a step, and of no use.
class Simulation {
 public:
  /// Reads a scene file (docs/scenes.md) and builds its first state.
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

  /// Runs whole steps (docs/automaton.md, section 3).
  /// @throws InputError where step numbers would exceed 2^32 - 1
  /// @throws ResourceError when memory runs out
  void step(std::uint32_t count = 1);
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

  /// Draws the state into a PNG file, with the scene's camera, light and look.
  /// @throws InputError for numbers out of their range
  /// @throws OutputError where the file cannot be written
  /// @throws ResourceError when memory or disk space is used up
  void draw(const std::filesystem::path& file, const Picture& picture = {});

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace voxmelt
