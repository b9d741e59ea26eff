// OBJ counts vertices from 1 and over all objects; names end at the first blank.
#include "core/export/wavefront_obj.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>

#include "core/base/text.h"

namespace bl::exporting {

namespace {

std::string one_line(std::string text) {
  for (char& c : text) c = static_cast<unsigned char>(c) < 0x20 || c == '\\' ? ' ' : c;
  return text;
}

}  // namespace

// Blanks and control characters would end the name or the line; letters beyond ASCII are kept.
std::string name_in_obj(const std::string& name) {
  std::string legal;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    legal += byte <= 0x20 || byte == 0x7F || c == '#' || c == '\\' ? '_' : c;
  }
  return legal.empty() ? "object" : legal;
}

std::string write_obj(std::span<const NamedMesh> meshes, const std::string& note, const std::string& library) {
  std::string out = "# BehaviourLinks: lengths in metres, z up\n";
  if (!note.empty()) out.append("# ").append(one_line(note)).append("\n");
  if (!library.empty()) out.append("mtllib ").append(library).append("\n");
  std::set<std::string> used;
  std::map<std::string, int> numbers;  // the last one given to each name
  std::size_t first = 1;
  for (const NamedMesh& named : meshes) {
    if (named.mesh == nullptr || named.mesh->triangles.empty()) {
      out.append("# ").append(one_line(named.name)).append(": no shape\n");
      continue;
    }
    const std::string base = name_in_obj(named.name);
    std::string name = base;
    // From where the last one of that name left off: a thousand volumes of one name are not a thousand times a thousand looks.
    int& number = numbers[base];
    while (!used.insert(name).second) name = base + "_" + std::to_string(number = std::max(2, number + 1));
    if (name != named.name) out.append("# ").append(one_line(named.name)).append("\n");
    out.append("o ").append(name).append("\n");
    if (!named.material.empty()) out.append("usemtl ").append(name_in_obj(named.material)).append("\n");
    for (const Point3& v : named.mesh->vertices)
      out.append("v ").append(shortest(v.x)).append(" ").append(shortest(v.y)).append(" ").append(shortest(v.z)).append("\n");
    for (const auto& triangle : named.mesh->triangles) {
      out += 'f';
      for (const std::uint32_t corner : triangle) out.append(" ").append(std::to_string(first + corner));
      out += '\n';
    }
    first += named.mesh->vertices.size();
  }
  return out;
}

}  // namespace bl::exporting
