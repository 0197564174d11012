// SPDX-License-Identifier: BSD-3-Clause
// Material constants and state variables, each declared once. The same tables read and validate PROPS,
// name the keys of material files, print the manual's tables and bound a calibration. Free of the model.
#pragma once
#include <array>
#include <limits>
#include <string>
#include <string_view>

namespace simsand {

struct ParameterInfo {
  std::string_view symbol;
  std::string_view key;     ///< name in material files
  std::string_view unit;    ///< "stress": any unit of stress, the same one throughout
  double lower, upper;      ///< admissible, ends included
  double fallback_per_p_at; ///< taken when absent or 0, in units of p_at; NaN: must be given
  std::string_view meaning;
};

inline constexpr double required = std::numeric_limits<double>::quiet_NaN();

/// PROPS, in this order.
inline constexpr std::array<ParameterInfo, 14> parameters{{
    {"K₀", "K0", "-", 1, 1e5, required, "reference bulk modulus"},
    {"ν", "nu", "-", 0, 0.45, required, "Poisson's ratio"},
    {"n", "n", "-", 0, 0.9, required, "exponent of pressure in the bulk modulus"},
    {"φ", "phi", "deg", 1, 60, required, "friction angle at the critical state"},
    {"e_ref", "e_ref", "-", 0.05, 2, required, "critical void ratio at zero pressure"},
    {"λ", "lambda", "-", 0, 1, required, "slope of the critical state line"},
    {"ζ", "zeta", "-", 0.01, 2, required, "exponent of pressure in the critical state line"},
    {"A_d", "A_d", "-", 0, 10, required, "magnitude of the dilatancy"},
    {"k_p", "k_p", "-", 1e-5, 1, required, "plastic shear strain at half of the peak strength"},
    {"n_p", "n_p", "-", 0, 20, required, "interlocking: peak strength"},
    {"n_d", "n_d", "-", 0, 20, required, "interlocking: phase transformation"},
    {"e₀", "e0", "-", 0.05, 2, required, "initial void ratio, used while STATEV(1) is 0"},
    {"p_at", "p_at", "stress", 1e-6, 1e9, required, "atmospheric pressure: fixes the unit of stress"},
    {"p_min", "p_min", "stress", 0, 1e7, 1e-5, "smallest mean stress in moduli and critical state line"},
}};

/// Position in PROPS, from 0, of the parameter with this key; -1: there is none.
constexpr int parameter_index(std::string_view key) noexcept {
  for (int i = 0; i < int(parameters.size()); ++i)
    if (parameters[i].key == key) return i;
  return -1;
}

/// Whether the keys of the table, in its order and separated by ", ", make up a text.
constexpr bool are_parameters(std::string_view keys) noexcept {
  for (const ParameterInfo& info : parameters) {
    const bool last = &info == &parameters[parameters.size() - 1];
    if (keys.substr(0, info.key.size()) != info.key) return false;
    keys.remove_prefix(info.key.size());
    if (keys.substr(0, 2) != (last ? "" : ", ")) return false;
    keys.remove_prefix(last ? 0 : 2);
  }
  return keys.empty();
}

/// The numbers of one material, named and ordered as in the table; phi in degrees.
template <class Real> struct Parameters {
  Real K0, nu, n, phi, e_ref, lambda, zeta, A_d, k_p, n_p, n_d, e0, p_at, p_min;
};
static_assert(are_parameters("K0, nu, n, phi, e_ref, lambda, zeta, A_d, k_p, n_p, n_d, e0, p_at, p_min"));
static_assert(sizeof(Parameters<double>) == parameters.size() * sizeof(double));

/// Why PROPS were refused; entry 0: they were not.
struct PropsError {
  int entry = 0; ///< position in PROPS, from 1
  const char* reason = "";
};

/// Reads and validates `count` PROPS. Entries beyond the table are ignored.
template <class Real> PropsError read_props(const Real* props, int count, Parameters<Real>& out) noexcept;

struct StateInfo {
  std::string_view name, unit, meaning;
};

/// Positions in STATEV, from 0.
namespace statev {
enum Index { void_ratio, plastic_deviatoric_strain, separation_strain, status, nonconvex_updates };
}

/// Outcome of an update, as written to STATEV(4). A property refused is -100 - its position from 1.
enum class Status : int {
  elastic = 0,
  plastic = 1,
  stress_free = 2,
  substepped = 3,
  exhausted = -1,   ///< no solution within the bounded number of iterations and substeps
  bad_input = -2,   ///< stress, strain or state not finite, e not positive or eps_d negative
  unsupported = -3, ///< ndir, nshr or nstatev
  bad_property = -100
};

inline constexpr std::array<StateInfo, 5> state_variables{{
    {"void_ratio", "-", "0 before the first update: take e0 and place the stress on the yield surface"},
    {"plastic_deviatoric_strain", "-", "hardening variable, sum of the plastic multiplier"},
    {"separation_strain", "-", "volumetric extension to be closed before stress returns"},
    {"status", "-",
     "of the last update: 0 elastic, 1 plastic, 2 stress free, 3 substepped, negative: failed"},
    {"nonconvex_updates", "-",
     "plastic updates with a peak friction beyond 46.5 degrees, where (7) is not convex"},
}};

static_assert(state_variables[statev::void_ratio].name == "void_ratio" &&
              state_variables[statev::plastic_deviatoric_strain].name == "plastic_deviatoric_strain" &&
              state_variables[statev::separation_strain].name == "separation_strain" &&
              state_variables[statev::status].name == "status" &&
              state_variables[statev::nonconvex_updates].name == "nonconvex_updates");

/// The two tables as Markdown, for manuals.
std::string parameter_table();
std::string state_table();

} // namespace simsand
