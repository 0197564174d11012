// SPDX-License-Identifier: BSD-3-Clause
// The result file: what is written is what is read, in the order of creation, also after an exception,
// a kill and a full disk; errors are one line that names the file.
#include "host/files/output.hpp"
#include "host/files/result_read.hpp"
#include <H5Cpp.h>
#include <cmath>
#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

using host::Quantity, host::Field, host::ResultFile, host::ResultHeader;
using Vector = std::vector<double>;

/// A fresh folder beside the test program: the files stay for a look.
std::filesystem::path folder(const std::string& name) {
  const auto path = std::filesystem::path("output_test_results") / name;
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path;
}

ResultHeader header(std::size_t particles) {
  return {"[scene]\nspacing = 0.002\n",
          "0.1.0",
          "g++ 12.2.0 -O3",
          "0123456789abcdef fedcba9876543210",
          "axisymmetric",
          2,
          particles};
}

const std::vector<Quantity> two_columns = {{"time", "s"}, {"height", "m"}};

Vector read(const std::filesystem::path& path, const std::string& name) {
  const H5::H5File file(path.string(), H5F_ACC_RDONLY);
  const auto dataset = file.openDataSet(name);
  Vector values(dataset.getSpace().getSimpleExtentNpoints());
  dataset.read(values.data(), H5::PredType::NATIVE_DOUBLE);
  return values;
}

std::string unit(const std::filesystem::path& path, const std::string& name) {
  std::string text;
  const auto a = H5::H5File(path.string(), H5F_ACC_RDONLY).openDataSet(name).openAttribute("unit");
  a.read(a.getStrType(), text);
  return text;
}

int complete(const std::filesystem::path& path) {
  int value = -1;
  H5::H5File(path.string(), H5F_ACC_RDONLY).openAttribute("complete").read(H5::PredType::NATIVE_INT, &value);
  return value;
}

/// The message of the error that `action` must throw.
template <class Action> std::string error_of(const Action& action) {
  try {
    action();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "no error";
}

bool one_line_with(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos && text.find('\n') == std::string::npos;
}

/// Runs `action` in a child process; true when it ended by `signal` (0: by a regular exit with code 0).
template <class Action> bool child_ends_by(int signal, const Action& action) {
  const pid_t child = fork();
  if (child == 0) {
    action();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return signal ? WIFSIGNALED(status) && WTERMSIG(status) == signal
                : WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(Output, reads_back_in_the_order_of_creation) {
  const auto path = folder("order") / "a.h5";
  // Three particles in a cluster of four: the second place is padding.
  const Vector r{0.3, -9, 0.1, 0.2}, z{3, -9, 1, 2}, radii{0, 0.5}, heights{2, 1};
  const std::vector<std::int32_t> original{2, -1, 0, 1};
  const std::vector<Field> fields{{"position", "m", {r, z}}, {"void_ratio", "1", {z}}};
  {
    ResultFile file(path, header(3), two_columns);
    file.particles(std::vector<Field>{{"initial_position", "m", {r, z}}}, original);
    file.outline_radii(radii);
    file.snapshot(0.25, fields, original, heights);
    file.sample(Vector{0.0, 5.0});
    file.sample(Vector{0.1, 4.0});
    file.summary({"height", "m"}, 1.0);
    file.summary({"height", "m"}, 4.0);
    file.close();
  }
  EXPECT_EQ(read(path, "/particles/initial_position"), (Vector{0.1, 1, 0.2, 2, 0.3, 3}));
  EXPECT_EQ(read(path, "/snapshots/0000/position"), (Vector{0.1, 1, 0.2, 2, 0.3, 3}));
  EXPECT_EQ(read(path, "/snapshots/0000/void_ratio"), (Vector{1, 2, 3}));
  EXPECT_EQ(read(path, "/snapshots/0000/outline"), heights);
  EXPECT_EQ(read(path, "/outline/r"), radii);
  EXPECT_EQ(read(path, "/series/time"), (Vector{0.0, 0.1}));
  EXPECT_EQ(read(path, "/series/height"), (Vector{5.0, 4.0}));
  EXPECT_EQ(read(path, "/summary/height"), (Vector{4.0}));
  EXPECT_EQ(unit(path, "/series/height"), "m");
  EXPECT_EQ(unit(path, "/snapshots/0000/void_ratio"), "1");
  EXPECT_EQ(complete(path), 1);
}

TEST(Output, keeps_the_scene_to_the_letter) {
  const auto path = folder("scene") / "a.h5";
  ResultFile(path, header(0), {}).close();
  EXPECT_EQ(host::stored_scene(path), header(0).scene);

  const auto other = path.parent_path() / "b.h5";
  EXPECT_TRUE(one_line_with(error_of([&] { host::stored_scene(other); }), "b.h5: no such file"));
  std::ofstream(other) << "not HDF5";
  EXPECT_TRUE(one_line_with(error_of([&] { host::stored_scene(other); }), "b.h5: not a readable result"));
}

TEST(Output, survives_an_exception) {
  const auto path = folder("exception") / "a.h5";
  const Vector x{1, 2};
  try {
    ResultFile file(path, header(2), two_columns);
    file.snapshot(0, std::vector<Field>{{"position", "m", {x, x}}});
    file.sample(Vector{0, 5});
    throw std::runtime_error("the material returned NaN");
  } catch (const std::runtime_error&) {}
  EXPECT_EQ(read(path, "/snapshots/0000/position"), (Vector{1, 1, 2, 2}));
  EXPECT_EQ(read(path, "/series/height"), (Vector{5}));
  EXPECT_EQ(complete(path), 0);
}

TEST(Output, survives_a_kill) {
  const auto path = folder("kill") / "a.h5";
  ASSERT_TRUE(child_ends_by(SIGKILL, [&] {
    const Vector x(5000, 1.5);
    ResultFile file(path, header(x.size()), two_columns);
    for (int k = 0; k < 40; ++k) {
      file.snapshot(k, std::vector<Field>{{"position", "m", {x, x}}});
      file.sample(Vector{double(k), 5});
    }
    kill(getpid(), SIGKILL);
  }));
  EXPECT_EQ(read(path, "/snapshots/0039/position"), Vector(10000, 1.5));
  EXPECT_GE(read(path, "/series/time").size(), 39) << "all until the last snapshot";
  EXPECT_TRUE(std::filesystem::exists(path.parent_path() / "a.xdmf"));
}

TEST(Output, survives_a_full_disk) {
  const auto path = folder("full") / "a.h5";
  std::string message;
  const auto fill = [&] {
    // A limit on the size of a file stands for the disk's.
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1 << 16, 1 << 16};
    setrlimit(RLIMIT_FSIZE, &limit);
    Vector x(5000), y(5000);
    ResultFile file(path, header(x.size()), two_columns);
    message = error_of([&] {
      for (int k = 0; k < 10; ++k) {
        for (std::size_t i = 0; i < 1000U << k && i < x.size(); ++i)
          x[i] = std::sin(1e5 * double(i) + k),
          y[i] = std::sin(1e6 * double(i) + k); // ever harder to compress
        file.snapshot(k, std::vector<Field>{{"position", "m", {x, y}}});
        file.sample(Vector{double(k), 5});
      }
    });
    if (!one_line_with(message, "a.h5: cannot write /snapshots/000") ||
        message.find("File too large") == message.npos)
      _exit(1);
  };
  ASSERT_TRUE(child_ends_by(0, fill));
  EXPECT_EQ(read(path, "/snapshots/0001/position").size(), 10000);
  EXPECT_GE(read(path, "/series/time").size(), 2);
  EXPECT_EQ(complete(path), 0);
}

TEST(Output, survives_a_disk_too_full_to_join_the_snapshots) {
  const auto path = folder("full_join") / "a.h5";
  ASSERT_TRUE(child_ends_by(0, [&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1 << 16, 1 << 16};
    setrlimit(RLIMIT_FSIZE, &limit);
    Vector x(1500);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::sin(1e5 * double(i));
    ResultFile file(path, header(x.size()), two_columns);
    for (int k = 0; k < 8; ++k) file.snapshot(k, std::vector<Field>{{"position", "m", {x, x}}});
    const auto message = error_of([&] { file.close(); });
    if (!one_line_with(message, "a.h5: cannot write the joined snapshots (File too large")) _exit(1);
  }));
  EXPECT_EQ(read(path, "/snapshots/0007/position").size(), 3000);
  EXPECT_EQ(complete(path), 0);
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".part"));
}

TEST(Output, joins_its_parts_at_the_end_and_not_before) {
  const auto path = folder("parts") / "a.h5", parts = host::parts_folder(path);
  const Vector x{1, 2};
  ResultFile file(path, header(2), two_columns);
  file.snapshot(0, std::vector<Field>{{"position", "m", {x, x}}});
  EXPECT_TRUE(std::filesystem::exists(parts / "0000.h5"));
  EXPECT_EQ(read(path, "/snapshots/0000/position"), (Vector{1, 1, 2, 2})) << "while the run goes on";
  EXPECT_TRUE(one_line_with(error_of([&] { ResultFile(path, header(2), two_columns); }),
                            "a.h5: another run is writing this file"));
  file.close();
  EXPECT_FALSE(std::filesystem::exists(parts));
  std::filesystem::rename(path, path.parent_path() / "moved.h5");
  EXPECT_EQ(read(path.parent_path() / "moved.h5", "/snapshots/0000/position"), (Vector{1, 1, 2, 2}));
}

TEST(Output, goes_on_where_it_is_told) {
  const auto path = folder("goes_on") / "a.h5";
  const Vector x{1, 2}, y{3, 4};
  const std::vector<Field> first{{"position", "m", {x, x}}}, other{{"position", "m", {y, y}}};
  host::ResultProgress progress;
  {
    ResultFile file(path, header(2), two_columns);
    file.snapshot(0, first);
    file.sample(Vector{0, 5});
    progress = file.progress();
    file.sample(Vector{1, 4});
    file.snapshot(1, first);
  }
  ResultFile file(path, header(2), two_columns, progress);
  file.sample(Vector{2, 3});
  file.snapshot(2, other);
  file.close();
  EXPECT_EQ(read(path, "/series/time"), (Vector{0, 2}));
  EXPECT_EQ(read(path, "/snapshots/0001/position"), (Vector{3, 3, 4, 4}));

  std::filesystem::create_directories(host::parts_folder(path));
  ResultFile without(path, header(2), two_columns, progress);
  EXPECT_EQ(without.left_out(), std::vector{host::parts_folder(path) / "0000.h5"});
  EXPECT_EQ(without.progress().lost, std::vector{0});
  EXPECT_EQ(without.progress().xdmf, "");
  without.particles({});
  without.snapshot(2, other);
  without.close();
  EXPECT_EQ(read(path, "/snapshots/0001/position"), (Vector{3, 3, 4, 4}));
  EXPECT_FALSE(H5::H5File(path.string(), H5F_ACC_RDONLY).nameExists("snapshots/0000"));
}

TEST(Output, says_in_one_line_what_is_wrong) {
  const auto at = folder("bad");
  std::ofstream(at / "plain") << "a file, not a folder";
  EXPECT_TRUE(one_line_with(error_of([&] { ResultFile(at / "plain" / "sub" / "a.h5", header(2), {}); }),
                            "cannot create the output folder (Not a directory)"));
  EXPECT_TRUE(one_line_with(error_of([&] { ResultFile(at, header(2), {}); }),
                            "cannot create the result file (Is a directory)"));

  const Vector two{1, 2}, three{1, 2, 3};
  const std::vector<std::int32_t> twice{0, 0}, far{0, 2}, one{0, -1};
  const std::vector<Field> good{{"position", "m", {two, two}}}, uneven{{"position", "m", {two, three}}},
      nowhere{{"velocity", "m/s", {two, two}}};
  ResultFile file(at / "a.h5", header(2), two_columns);
  const auto snapshot = [&](auto&&... arguments) {
    return error_of([&] { file.snapshot(0, arguments...); });
  };
  EXPECT_TRUE(one_line_with(snapshot(uneven), "a.h5: cannot write /snapshots/0000 (field position"));
  EXPECT_TRUE(one_line_with(snapshot(nowhere), "no position"));
  EXPECT_TRUE(one_line_with(snapshot(good, twice), "particle number 0 out of place"));
  EXPECT_TRUE(one_line_with(snapshot(good, far), "particle number 2 out of place"));
  EXPECT_TRUE(one_line_with(snapshot(good, one), "covers 1 of 2 particles"));
  EXPECT_TRUE(one_line_with(snapshot(good, std::span<const std::int32_t>{}, three), "3 heights for 0 radii"));
  EXPECT_TRUE(one_line_with(error_of([&] { file.sample(three); }), "3 values for 2 columns"));
  EXPECT_EQ(snapshot(good), "no error") << "a refused snapshot leaves nothing behind";
  file.close();
  EXPECT_TRUE(one_line_with(error_of([&] { file.close(); }), "the file is closed"));
}

/// A made-up collapse, for the figures: particles above a cone move out and down within 0.35 s.
TEST(Output, writes_a_file_for_the_figures) {
  const auto path = folder("figures") / "collapse.h5";
  const double radius = 0.05, spacing = 0.002, bulk_density = 1730, gravity = 9.81;
  const int columns = 25, layers = 25, times = 21;
  Vector r0, z0, mass;
  for (int j = 0; j < layers; ++j)
    for (int i = 0; i < columns; ++i) {
      r0.push_back((i + 0.5) * spacing);
      z0.push_back((j + 0.5) * spacing);
      mass.push_back(2 * std::numbers::pi * r0.back() * spacing * spacing * bulk_density);
    }
  Vector radii;
  for (double r = 0; r < 3 * radius; r += spacing) radii.push_back(r);

  const std::size_t n = r0.size();
  auto head = header(n);
  head.scene =
      "[scene]\ngeometry = \"axisymmetric\"\nspacing = 0.002\n[column]\nradius = 0.05\nheight = 0.05\n"
      "[output]\ngrain_diameter = 0.00295\n";
  ResultFile file(path, head,
                  {{"time", "s"},
                   {"height", "m"},
                   {"front_radius", "m"},
                   {"kinetic_energy", "J"},
                   {"potential_energy", "J"},
                   {"work_stress", "J"},
                   {"work_viscosity", "J"},
                   {"work_friction", "J"},
                   {"step_size", "s"}});
  file.particles(std::vector<Field>{{"mass", "kg", {mass}}, {"initial_position", "m", {r0, z0}}});
  file.outline_radii(radii);

  double first_potential = 0;
  for (int k = 0; k < times; ++k) {
    const double t = 0.05 * k, s = std::min(t / 0.35, 1.0), progress = s * s * (3 - 2 * s);
    const double rate = s < 1 ? 6 * s * (1 - s) / 0.35 : 0;
    Vector r(n), z(n), vr(n), vz(n), density(n), e(n), hardening(n), rr(n), zz(n), tt(n), rz(n),
        outline(radii);
    std::fill(outline.begin(), outline.end(), 0.0);
    double kinetic = 0, potential = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double w = std::clamp((z0[i] - 0.6 * (radius - r0[i])) / 0.03, 0.0, 1.0),
                   loosening = w * progress;
      r[i] = r0[i] * (1 + 0.9 * loosening);
      z[i] = z0[i] * (1 - 0.6 * loosening);
      vr[i] = 0.9 * r0[i] * w * rate;
      vz[i] = -0.6 * z0[i] * w * rate;
      e[i] = 0.445 + 0.25 * loosening;
      hardening[i] = 0.1 * loosening;
      density[i] = 2500 / (1 + e[i]);
      zz[i] = -density[i] * gravity * std::max(0.0, radius * (1 - 0.5 * loosening) - z[i]);
      rr[i] = tt[i] = 0.59 * zz[i];
      kinetic += 0.5 * mass[i] * (vr[i] * vr[i] + vz[i] * vz[i]);
      potential += mass[i] * gravity * z[i];
      for (std::size_t m = 0; m < radii.size(); ++m)
        if (std::abs(radii[m] - r[i]) < 2 * spacing) outline[m] = std::max(outline[m], z[i] + spacing / 2);
    }
    if (k == 0) first_potential = potential;
    const double lost = first_potential - potential - kinetic;
    const std::vector<Field> fields{
        {"position", "m", {r, z}},          {"velocity", "m/s", {vr, vz}},
        {"stress", "Pa", {rr, zz, tt, rz}}, {"density", "kg/m3", {density}},
        {"state_void_ratio", "1", {e}},     {"state_hardening", "1", {hardening}}};
    file.snapshot(t, fields, {}, outline);
    const double height = radius * (1 - 0.6 * progress * 0.67), front = radius * (1 + 0.9 * progress);
    file.sample(Vector{t, height, front, kinetic, potential, -0.7 * lost, -0.1 * lost, -0.2 * lost, 1e-5});
  }
  file.summary({"final_height", "m"}, 0.03);
  file.close();
  EXPECT_EQ(complete(path), 1);
}

} // namespace
