// The structs and enumerations of the public headers.
#include <pybind11/pybind11.h>
#include <voxmelt/voxmelt.h>

#include <initializer_list>
#include <utility>

#include "python/docs.h"
#include "python/module.h"
#include "python/record.h"

namespace voxmelt::python {
namespace {

template <class E>
void add_enum(py::module_& m, const char* name, std::initializer_list<std::pair<const char*, E>> values) {
  py::enum_<E> made(m, name, doc(name));
  for (const auto& [word, value] : values) made.value(word, value);
  py::module_::import("voxmelt._record").attr("finish_enum")(made);
}

void add_enums(py::module_& m) {
  add_enum<CellColours>(m, "CellColours",
                        {{"phase", CellColours::phase},
                         {"temperature", CellColours::temperature},
                         {"sleep", CellColours::sleep}});
  add_enum<Axis>(m, "Axis", {{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}});
  add_enum<Quality>(m, "Quality",
                    {{"fast", Quality::fast}, {"normal", Quality::normal}, {"best", Quality::best}});
  add_enum<Projection>(
      m, "Projection",
      {{"perspective", Projection::perspective}, {"orthographic", Projection::orthographic}});
  add_enum<Shown>(m, "Shown",
                  {{"solid", Shown::solid},
                   {"liquid", Shown::liquid},
                   {"obstacle", Shown::obstacle},
                   {"ground", Shown::ground}});
  add_enum<TexelFormat>(m, "TexelFormat",
                        {{"u16", TexelFormat::u16},
                         {"u8x4", TexelFormat::u8x4},
                         {"u32x2", TexelFormat::u32x2},
                         {"u32x4", TexelFormat::u32x4},
                         {"i32", TexelFormat::i32},
                         {"i32x2", TexelFormat::i32x2}});
  add_enum<HeatSourceKind>(m, "HeatSourceKind",
                           {{"point", HeatSourceKind::point},
                            {"sphere", HeatSourceKind::sphere},
                            {"directional", HeatSourceKind::directional},
                            {"sky", HeatSourceKind::sky}});
}

void add_sources(py::module_& m) {
  Record<Keyframe>(m, "Keyframe")
      .field("step", &Keyframe::step)
      .field("at", &Keyframe::at)
      .field("power", &Keyframe::power)
      .field("radius", &Keyframe::radius)
      .field("direction", &Keyframe::direction)
      .made_by_users();
  Record<HeatSource>(m, "HeatSource")
      .field("keyframes", &HeatSource::keyframes)
      .field("kind", &HeatSource::kind)
      .made_by_users()
      .def_static("fixed", &HeatSource::fixed, doc("HeatSource::fixed"), py::arg("at"), py::arg("power"));
  Record<Vent>(m, "Vent")
      .field("at", &Vent::at)
      .field("radius", &Vent::radius)
      .field("rate", &Vent::rate)
      .field("temperature", &Vent::temperature)
      .field("energy", &Vent::energy)
      .field("from_", &Vent::from)
      .field("until", &Vent::until)
      .made_by_users();
  Record<Drain>(m, "Drain")
      .field("at", &Drain::at)
      .field("radius", &Drain::radius)
      .field("rate", &Drain::rate)
      .field("from_", &Drain::from)
      .field("until", &Drain::until)
      .made_by_users();
  m.attr("NEVER") = kNever;
}

void add_pictures(py::module_& m) {
  Record<Camera>(m, "Camera")
      .field("target", &Camera::target)
      .field("distance", &Camera::distance)
      .field("azimuth", &Camera::azimuth)
      .field("elevation", &Camera::elevation)
      .field("field_of_view", &Camera::field_of_view)
      .field("projection", &Camera::projection)
      .made_by_users();
  Record<Picture>(m, "Picture")
      .field("camera", &Picture::camera)
      .field("width", &Picture::width)
      .field("height", &Picture::height)
      .field("azimuth", &Picture::azimuth)
      .field("elevation", &Picture::elevation)
      .field("quality", &Picture::quality)
      .field("depth", &Picture::depth)
      .field("row_alignment", &Picture::row_alignment)
      .made_by_users();
  Record<Cell>(m, "Cell").field("x", &Cell::x).field("y", &Cell::y).field("z", &Cell::z).made_by_users();
  Record<Hit>(m, "Hit")
      .shows("shown", &Hit::shown)
      .shows("position", &Hit::position)
      .shows("normal", &Hit::normal)
      .shows("depth", &Hit::depth)
      .shows("cell", &Hit::cell)
      .shows("matter", &Hit::matter)
      .made_here();
  Record<CellCut>(m, "CellCut").field("axis", &CellCut::axis).field("at", &CellCut::at).made_by_users();
  Record<CellView>(m, "CellView")
      .field("colours", &CellView::colours)
      .field("cut", &CellView::cut)
      .made_by_users();
  Record<LegendMark>(m, "LegendMark")
      .shows("name", &LegendMark::name)
      .shows("rgb", &LegendMark::rgb)
      .made_here();
}

void add_books(py::module_& m) {
  Record<Term>(m, "Term").shows("name", &Term::name).shows("value", &Term::value).made_here();
  Record<Ledger>(m, "Ledger")
      .shows("start", &Ledger::start)
      .shows("terms", &Ledger::terms)
      .shows("held", &Ledger::held)
      .made_here()
      .def("drift", &Ledger::drift, doc("Ledger::drift"));
  Record<Ledgers>(m, "Ledgers")
      .shows("mass", &Ledgers::mass)
      .shows("energy", &Ledgers::energy)
      .shows("heat", &Ledgers::heat)
      .made_here()
      .def("balance", &Ledgers::balance, doc("Ledgers::balance"));
}

}  // namespace

void add_records(py::module_& m) {
  add_enums(m);
  add_sources(m);
  add_pictures(m);
  add_books(m);
  Record<Grid>(m, "Grid")
      .field("x", &Grid::x)
      .field("y", &Grid::y)
      .field("z", &Grid::z)
      .made_by_users()
      .def("cells", &Grid::cells, doc("Grid::cells"));
  Record<Implementation>(m, "Implementation")
      .shows("name", &Implementation::name)
      .shows("description", &Implementation::description)
      .shows("supported", &Implementation::supported)
      .made_here();
  Record<Format>(m, "Format")
      .shows("name", &Format::name)
      .shows("description", &Format::description)
      .made_here();
  Record<SceneChange>(m, "SceneChange")
      .field("steps_done", &SceneChange::steps_done)
      .field("what", &SceneChange::what)
      .made_by_users();
  Record<ChangedBrick>(m, "ChangedBrick")
      .shows("x", &ChangedBrick::x)
      .shows("y", &ChangedBrick::y)
      .shows("z", &ChangedBrick::z)
      .shows("matter", &ChangedBrick::matter)
      .made_here();
  Record<Changes>(m, "Changes")
      .shows("version", &Changes::version)
      .shows("everything", &Changes::everything)
      .shows("bricks", &Changes::bricks)
      .made_here();
  m.attr("BRICK_SIDE") = kBrickSide;
}

}  // namespace voxmelt::python
