// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/abaqus/page.hpp"
#include "drivers/run/laws.hpp"
#include <cmath>
#include <fmt/format.h>

namespace drivers {
namespace {

std::string running(bool own_material, bool with_source) {
  std::string out = "## Run\n\n";
  if (!own_material)
    out += "The material is not SIMSAND: put the source of its VUMAT beside the deck and name it after "
           "`user=`.\n\n";
  else if (!with_source)
    out +=
        fmt::format("`{}` is missing here: the program that wrote this folder comes without it. Build the "
                    "project's single source file for ABAQUS (a target of its build) and copy it here.\n\n",
                    abaqus_subroutine);
  out += fmt::format("```\nabaqus job={} user={} double=both cpus=8\n```\n\n", abaqus_job,
                     own_material ? abaqus_subroutine : "YOUR_VUMAT");
  return out +
         "`double=both` is needed: the subroutine is in double precision. Try `abaqus job=... datacheck` "
         "first.\n\n";
}

std::string contents(const host::Scene& scene, const AbaqusModel& m) {
  const bool slab = m.depth > 0;
  std::string out = "## What the deck holds\n\n";
  out += slab ? fmt::format(
                    "- A slab of {} particles ({:.6g} m) between two frictionless rigid sides, on both sides "
                    "of x = 0, as particle elements see no plane of symmetry. ",
                    slab_particles, m.depth)
              : "- The full cylinder, as particle elements see no plane of symmetry. ";
  out += fmt::format(
      "{} elements PC3D in {} layers: centres of a square lattice of {:.6g} m that lie inside the column, "
      "layers "
      "{:.6g} m apart.\n"
      "- All particles are equal. A particle is a cube of edge {:.9g} m, so that together they have exactly "
      "the column's "
      "volume, {:.9g} m3, and mass, {:.9g} kg. The characteristic length in the section is half the edge.\n",
      m.particles.size(), m.layers.size(), m.pitch, m.rise, m.edge, m.volume, m.volume * scene.bulk_density);
  out += fmt::format(
      "- Geostatic stress, layer by layer: vertical (33) from the weight above, horizontal {:.6g} of it. "
      "Stress is tension "
      "positive, in the order 11, 22, 33, 12, 13, 23.\n"
      "- State variables at the start: {}.\n",
      scene.earth_pressure_ratio,
      scene.friction_angle > 0
          ? "what SIMSAND answers to the layer's stress without any strain: the void ratio of the scene, and "
            "the hardening variable that puts the stress on the yield surface"
          : "those of the scene");
  out += scene.floor.no_slip
             ? "- Rigid floor z = 0, rough: no slip while in contact.\n"
             : fmt::format("- Rigid floor z = 0, friction coefficient {:.6g}.\n", scene.floor.friction);
  if (scene.gate.motion == host::GateMotion::remove)
    out += "- No wall: the scene removes it at once.\n";
  else
    out += fmt::format(
        "- Rigid frictionless wall that touches the outermost particles{}.\n",
        scene.gate.motion == host::GateMotion::lift
            ? fmt::format(", lifted at {:.6g} m/s from the start and stopped two column heights up",
                          scene.gate.speed)
            : ", fixed");
  out += fmt::format(
      "- Contact of particles with rigid parts only, at half a layer ({:.6g} m) from a particle's centre.\n"
      "- Cubic kernel; tracking box from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) m: twice the "
      "runout of published "
      "laws at least. A particle that leaves it is lost; enlarge it in `*SECTION CONTROLS` and the floor "
      "with it.\n"
      "- Bulk viscosity at ABAQUS's defaults (0.06 linear, 1.2 quadratic), no mass scaling, gravity {:.6g} "
      "m/s2, end at "
      "{:.6g} s. The particle host of simsand uses other viscosities and a correction of the velocity "
      "gradient "
      "that PC3D lacks: "
      "expect deposits that agree in shape, not to the digit.\n\n",
      0.5 * m.rise, m.box_lower[0], m.box_lower[1], m.box_lower[2], m.box_upper[0], m.box_upper[1],
      m.box_upper[2], scene.gravity, scene.end_time);
  return out;
}

std::string reading(const host::Scene& scene, const AbaqusModel& m) {
  const double h = scene.numerics.smoothing_length * m.edge;
  std::string out = fmt::format(
      "## Read\n\n"
      "Field output: displacement U, velocity V, stress S, state variables SDV_..., density. History: "
      "energies and the "
      "force on the floor (RF3 at the reference node of the floor; in the first instants it must be near the "
      "weight, "
      "{:.6g} N, else contact is not as intended).\n\n"
      "Height and runout are those of an outline, so that single grains in flight do not count:\n\n"
      "1. Take positions x = initial position + U of all particles in the last frame, and for each its "
      "distance ",
      m.volume * scene.bulk_density * scene.gravity);
  if (m.depth > 0)
    out += fmt::format(
        "|x| from the middle, height z and area A = V / {:.9g} m in the vertical plane, V its volume "
        "(initial volume {:.9g} m3 x initial density / density); each half of the column has its own "
        "outline.\n",
        m.depth, m.edge * m.edge * m.edge);
  else
    out += fmt::format(
        "r from the axis, height z and area A = V / (2 pi r) in the half plane, V its volume (initial "
        "volume {:.9g} m3 x initial density / density).\n",
        m.edge * m.edge * m.edge);
  out += fmt::format("2. Weigh with W(d) = 7 / (4 pi h^2) (1 - d/2h)^4 (1 + 2d/h) up to d = 2h, h = {:.6g} "
                     "m, and mirror the particles at "
                     "the {} and at the floor. The surface over a radius is the uppermost height where the "
                     "sum of A W is 1/2.\n"
                     "3. h_f is the largest height of the surface. r_f is the outermost radius where it is "
                     "{:.6g} m high, one grain. "
                     "Runout is (r_f - r_0) / r_0 with r_0 = {:.6g} m.\n\n",
                     h, m.depth > 0 ? "middle" : "axis", scene.grain_diameter, scene.column.radius);
  const auto known = [](double v) { return std::isfinite(v) ? fmt::format("{:.3f}", v) : std::string("-"); };
  out += "Published laws for this column:\n\n| law | h_f / r_0 | (r_f - r_0) / r_0 |\n|---|---|---|\n";
  for (const auto& law :
       column_laws(scene.geometry, scene.column.height / scene.column.radius, scene.friction_angle))
    out += fmt::format("| {} | {} | {} |\n", law.source, known(law.height), known(law.runout));
  return out + "\n";
}

constexpr const char* untried =
    "## Not tried\n\n"
    "This deck has never been run: there was no ABAQUS where it was made. It was written, and read back by a "
    "checker "
    "that shares no code with the writer, from the published keyword rules. What only a run can tell:\n\n"
    "- whether ABAQUS takes the thickness of the particles' surface as twice the distance of contact, as for "
    "shells "
    "(see the floor's force above);\n"
    "- the step that it finds from the subroutine's first answer, and the time that a run takes;\n"
    "- how the floor's lowest particles fare: the kernel sees no sand below the floor there, and contact "
    "replaces it;\n"
    "- the first instants: the column's side is as jagged as the lattice, so it leans on the wall at some "
    "particles and "
    "settles by a fraction of a particle.\n";

} // namespace

std::string abaqus_page(const host::Scene& scene, const AbaqusModel& m, bool with_source) {
  return "# A column of sand in ABAQUS/Explicit\n\n" +
         fmt::format("`{}.inp`: column of {} {:.6g} m and height {:.6g} m. SI units, z upwards.\n\n",
                     abaqus_job, m.depth > 0 ? "half width" : "radius", scene.column.radius,
                     scene.column.height) +
         running(scene.friction_angle > 0, with_source) + contents(scene, m) + reading(scene, m) + untried;
}

} // namespace drivers
