#include "comparisons/study/cell_journal.h"

#include "comparisons/reports/files.h"
#include "comparisons/reports/json.h"
#include "comparisons/scene/hash.h"
#include "comparisons/scene/reader.h"

#include <fmt/format.h>

#include <cerrno>
#include <fcntl.h>
#include <sstream>
#include <system_error>
#include <unistd.h>

namespace comparisons::study {

namespace {

namespace fs = std::filesystem;

/// Meshes, clouds, references: whatever text of the scene is the name of a file.
void add_files(const nlohmann::ordered_json &json, const fs::path &folder, scene::Hash &hash) {
  if (json.is_structured()) {
    for (const auto &item : json)
      add_files(item, folder, hash);
    return;
  }
  if (!json.is_string())
    return;
  const auto &name = json.get_ref<const std::string &>();
  std::error_code ignored;
  if (!name.empty() && fs::is_regular_file(folder / name, ignored)) {
    hash.add(name);
    hash.add(reports::file_contents(folder / name));
  }
}

void add_machine(const reports::Program &program, const reports::Machine &machine, scene::Hash &hash) {
  for (const auto &text : {program.version, program.commit, program.build_type, program.flags, machine.cpu,
                           machine.blas, fmt::format("{} {}", machine.cores, machine.memory_bytes)})
    hash.add(text);
}

std::string key_of(const std::string &identity, const reports::Cell &cell) {
  return fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}", identity, cell.benchmark, cell.scene, cell.variant, cell.label,
                     cell.level, cell.parameters.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

[[noreturn]] void fail(const fs::path &file, const char *what) {
  throw reports::OutputError(fmt::format("{}: {}: {}", file.string(), what, std::generic_category().message(errno)));
}

} // namespace

std::string identity_of(const scene::Scene &scene, const reports::Program &program, const reports::Machine &machine) {
  scene::Hash hash;
  hash.add(scene.hash);
  add_machine(program, machine, hash);
  add_files(scene::to_json(scene), fs::path(scene.file).parent_path(), hash);
  return hash.text();
}

std::string identity_of(const reports::Program &program, const reports::Machine &machine) {
  scene::Hash hash;
  add_machine(program, machine, hash);
  return hash.text();
}

CellJournal::CellJournal(fs::path file, bool resume) : file_(std::move(file)) {
  if (!resume) {
    remove();
    return;
  }
  std::istringstream lines(reports::file_contents(file_));
  for (std::string line; std::getline(lines, line);) {
    try {
      const auto json = nlohmann::ordered_json::parse(line);
      auto results = reports::from_json(json.at("results"));
      const auto &cell = results.cells.at(0);
      cells_[key_of(json.at("identity").get<std::string>(), cell)] = {
          cell, json.at("samples").get<std::map<std::string, std::vector<double>>>(), json.at("done").get<bool>()};
    } catch (const std::exception &) {
      // Cut off by a kill, or none of ours: its cell is run again.
    }
  }
}

std::optional<KeptCell> CellJournal::recall(const std::string &identity, const reports::Cell &described) {
  const auto found = cells_.find(key_of(identity, described));
  if (found == cells_.end())
    return {};
  std::error_code ignored;
  for (const auto &series : found->second.cell.series)
    if (!fs::is_regular_file(file_.parent_path() / series.file, ignored))
      return {};
  ++n_recalled_;
  return found->second;
}

void CellJournal::keep(const std::string &identity, const KeptCell &kept) {
  reports::Results results;
  results.cells.push_back(kept.cell);
  const nlohmann::ordered_json json{
      {"identity", identity}, {"results", reports::to_json(results)}, {"samples", kept.samples}, {"done", kept.done}};
  // The newline before it ends what a kill may have left.
  const std::string line = "\n" + json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  const int descriptor = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor < 0)
    fail(file_, "cannot be opened");
  const bool written =
      ::write(descriptor, line.data(), line.size()) == static_cast<ssize_t>(line.size()) && ::fsync(descriptor) == 0;
  const int error = errno;
  ::close(descriptor);
  errno = error;
  if (!written)
    fail(file_, "cannot write");
}

void CellJournal::remove() const {
  std::error_code ignored;
  fs::remove(file_, ignored);
}

} // namespace comparisons::study
