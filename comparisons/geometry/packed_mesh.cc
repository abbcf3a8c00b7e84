// A mesh on its way from the child process that reads it.

#include "comparisons/geometry/mesh_file.h"

#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace comparisons::geometry {

namespace {

/// Appends plain values to a text, and takes them off again.
class Packer {
public:
  template <typename T>
  void put(const T &value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char *>(&value), sizeof value);
  }
  template <typename T>
  void put_all(const std::vector<T> &values) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(values.size());
    bytes_.append(reinterpret_cast<const char *>(values.data()), values.size() * sizeof(T));
  }
  void put_text(const std::string &text) { put_all(std::vector<char>(text.begin(), text.end())); }
  std::string take() { return std::move(bytes_); }

private:
  std::string bytes_;
};

class Unpacker {
public:
  explicit Unpacker(const std::string &bytes) : bytes_(bytes) {}

  template <typename T>
  T get() {
    T value;
    copy(&value, sizeof value);
    return value;
  }
  template <typename T>
  std::vector<T> get_all() {
    const auto n = get<std::size_t>();
    if (n > (bytes_.size() - at_) / sizeof(T))
      throw std::runtime_error("a packed mesh is incomplete");
    std::vector<T> values(n);
    copy(values.data(), n * sizeof(T));
    return values;
  }
  std::string get_text() {
    const auto characters = get_all<char>();
    return {characters.begin(), characters.end()};
  }

private:
  void copy(void *target, std::size_t n) {
    if (n > bytes_.size() - at_)
      throw std::runtime_error("a packed mesh is incomplete");
    if (n > 0)
      std::memcpy(target, bytes_.data() + at_, n);
    at_ += n;
  }

  const std::string &bytes_;
  std::size_t at_ = 0;
};

} // namespace

std::string pack(const MeshFile &mesh) {
  Packer packer;
  packer.put_all(mesh.node_tags);
  packer.put_all(mesh.nodes);
  packer.put(mesh.groups.size());
  for (const auto &group : mesh.groups) {
    packer.put(group.dimension);
    packer.put(group.tag);
    packer.put_text(group.name);
  }
  packer.put(mesh.entities.size());
  for (const auto &entity : mesh.entities) {
    packer.put(entity.dimension);
    packer.put(entity.tag);
    packer.put_all(entity.groups);
  }
  packer.put_all(mesh.elements);
  packer.put_all(mesh.element_nodes);
  packer.put(mesh.messages.size());
  for (const auto &message : mesh.messages)
    packer.put_text(message);
  return packer.take();
}

MeshFile unpack(const std::string &bytes) {
  Unpacker unpacker(bytes);
  MeshFile mesh;
  mesh.node_tags = unpacker.get_all<std::uint64_t>();
  mesh.nodes = unpacker.get_all<std::array<double, 3>>();
  for (auto n = unpacker.get<std::size_t>(); n > 0; --n) {
    PhysicalGroup group;
    group.dimension = unpacker.get<int>();
    group.tag = unpacker.get<int>();
    group.name = unpacker.get_text();
    mesh.groups.push_back(std::move(group));
  }
  for (auto n = unpacker.get<std::size_t>(); n > 0; --n) {
    Entity entity;
    entity.dimension = unpacker.get<int>();
    entity.tag = unpacker.get<int>();
    entity.groups = unpacker.get_all<int>();
    mesh.entities.push_back(std::move(entity));
  }
  mesh.elements = unpacker.get_all<Element>();
  mesh.element_nodes = unpacker.get_all<std::uint32_t>();
  for (auto n = unpacker.get<std::size_t>(); n > 0; --n)
    mesh.messages.push_back(unpacker.get_text());
  return mesh;
}

} // namespace comparisons::geometry
