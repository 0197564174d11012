// SPDX-License-Identifier: BSD-3-Clause
#include "host/files/xdmf.hpp"
#include <fmt/format.h>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace host {

// The points of a Polyvertex are numbered outright: ParaView's Xdmf3 readers show nothing without it.
std::string xdmf_grid(const std::string& file, const std::string& group, double time, std::size_t particles,
                      std::span<const Field> fields) {
  const auto item = [&](const Field& f) {
    const std::size_t components = f.components.size();
    const auto size =
        components > 1 ? fmt::format("{} {}", particles, components) : fmt::to_string(particles);
    return fmt::format("<DataItem Dimensions=\"{}\" NumberType=\"Float\" Precision=\"8\" "
                       "Format=\"HDF\">{}:{}/{}</DataItem>",
                       size, file, group, f.name);
  };
  std::string text =
      fmt::format("   <Grid Name=\"particles\">\n    <Time Value=\"{}\"/>\n"
                  "    <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1\">"
                  "<DataItem Dimensions=\"{}\" NumberType=\"Int\" Precision=\"8\" Format=\"HDF\">"
                  "{}:/particles/number</DataItem></Topology>\n",
                  time, particles, particles, file);
  for (const Field& f : fields) {
    if (f.name == "position")
      text += fmt::format("    <Geometry GeometryType=\"{}\">{}</Geometry>\n",
                          f.components.size() == 2 ? "XY" : "XYZ", item(f));
    else
      text += fmt::format("    <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n",
                          f.name,
                          f.components.size() == 1   ? "Scalar"
                          : f.components.size() <= 3 ? "Vector"
                                                     : "Matrix",
                          item(f));
  }
  return text + "   </Grid>\n";
}

// Written beside and renamed, so that a reader never meets half a file.
void write_xdmf(const std::filesystem::path& to, const std::string& grids) {
  const std::filesystem::path part = to.string() + ".part";
  std::ofstream out(part);
  out << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n <Domain>\n"
         "  <Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n"
      << grids << "  </Grid>\n </Domain>\n</Xdmf>\n";
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(part, to, error);
  if (!out || error) throw std::runtime_error(fmt::format("{}: cannot write the XDMF file", to.string()));
}

std::string without_xdmf_grid(std::string grids, const std::string& group) {
  constexpr std::string_view begin = "   <Grid ", end = "</Grid>\n";
  const auto inside = grids.find(group);
  if (inside == std::string::npos) return grids;
  const auto first = grids.rfind(begin, inside), last = grids.find(end, inside) + end.size();
  return grids.erase(first, last - first);
}

} // namespace host
