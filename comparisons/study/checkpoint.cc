#include "comparisons/study/checkpoint.h"

#include "comparisons/reports/files.h"
#include "comparisons/reports/json_depth.h"
#include "comparisons/scene/hash.h"
#include "comparisons/study/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>

namespace comparisons::study {

namespace {

constexpr const char *format_name = "petrov checkpoint";
constexpr int schema = 1;

void add(scene::Hash &hash, const scene::Parameters &parameters) {
  for (const auto &parameter : parameters.all())
    if (parameter.declaration.name != "checkpoint_every" && parameter.declaration.name != "resume") {
      hash.add(parameter.declaration.name);
      hash.add(scene::to_text(parameter.value));
    }
}

/// Of all values by name.
std::string checksum(const meshless::dynamics::State &state) {
  scene::Hash hash;
  for (const auto &field : state) {
    hash.add(field.name);
    hash.add(field.values.data(), field.values.size_bytes());
  }
  return hash.text();
}

} // namespace

std::string identity_of(const scene::Scene &scene, const scene::ProblemVariant &variant,
                        const scene::MethodRequest &request, const scene::Level &level) {
  scene::Hash hash;
  hash.add(scene.benchmark);
  add(hash, variant.parameters);
  add(hash, scene.material);
  for (const auto &[effect, parameters] : scene.effect_parameters) {
    hash.add(effect);
    add(hash, parameters);
  }
  add(hash, scene.time);
  hash.add(request.name);
  add(hash, request.parameters);
  hash.add(level.text);
  hash.add(scene::to_text(scene::Value(scene.study.integer("seed"))));
  return hash.text();
}

std::filesystem::path checkpoint_file(const reports::Cell &cell) {
  const std::string stem = std::filesystem::path(series_file(cell, "checkpoint")).stem().string();
  return std::filesystem::path("checkpoints") / (stem + ".cbor");
}

void write_checkpoint(const std::filesystem::path &path, const std::string &identity,
                      const meshless::dynamics::State &state, const Measured &measured) {
  nlohmann::json json{{"format", format_name},
                      {"schema", schema},
                      {"identity", identity},
                      {"checksum", checksum(state)},
                      {"measured", measured}};
  for (const auto &field : state)
    json["fields"][field.name] = std::vector<double>(field.values.begin(), field.values.end());
  const auto bytes = nlohmann::json::to_cbor(json);
  std::error_code ignored; // the write says what is wrong
  std::filesystem::create_directories(path.parent_path(), ignored);
  reports::write_file_atomically(path, {reinterpret_cast<const char *>(bytes.data()), bytes.size()});
}

Measured read_checkpoint(const std::filesystem::path &path, const std::string &identity,
                         const meshless::dynamics::State &state) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw CheckpointError(fmt::format("checkpoint {}: cannot be read", path.string()));
  return parse_checkpoint({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()}, path.string(),
                          identity, state);
}

Measured parse_checkpoint(const std::string &bytes, const std::string &name, const std::string &identity,
                          const meshless::dynamics::State &state) {
  const auto fail = [&](const std::string &what) {
    throw CheckpointError(fmt::format("checkpoint {}: {}", name, what));
  };
  if (!reports::JsonDepth::is_bounded(bytes, nlohmann::json::input_format_t::cbor))
    fail("no checkpoint of this program: nested too deep; remove it, or set time.resume = false");
  nlohmann::json json(nlohmann::json::value_t::discarded);
  try {
    json = nlohmann::json::from_cbor(bytes.begin(), bytes.end(), true, false);
  } catch (const nlohmann::json::exception &) {
    // Thrown, whatever is asked for, by an array that is announced with more values than there can be.
  }
  if (json.is_discarded())
    fail("truncated or no checkpoint of this program; remove it, or set time.resume = false");
  if (!json.is_object() || json.value("format", nlohmann::json()) != format_name)
    fail("no checkpoint of this program; remove it, or set time.resume = false");
  if (json.value("schema", nlohmann::json()) != schema)
    // Of a string in CBOR nobody has looked whether it is UTF-8.
    fail(fmt::format(
        "schema {}; this version reads schema {}",
        json.value("schema", nlohmann::json()).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), schema));
  if (json.value("identity", nlohmann::json()) != identity)
    fail("belongs to another scene: problem, material, effects, time, method, level and seed must be the same; "
         "remove it, or set time.resume = false");
  std::vector<std::vector<double>> values;
  try {
    for (const auto &field : state)
      values.push_back(json.at("fields").at(field.name).get<std::vector<double>>());
  } catch (const nlohmann::json::exception &) {
    fail("a field is missing");
  }
  scene::Hash hash;
  for (std::size_t f = 0; f < state.size(); ++f) {
    if (values[f].size() != state[f].values.size())
      fail(fmt::format("the field '{}' has {} values, the run needs {}", state[f].name, values[f].size(),
                       state[f].values.size()));
    hash.add(state[f].name);
    hash.add(values[f].data(), values[f].size() * sizeof(double));
  }
  if (json.value("checksum", nlohmann::json()) != hash.text())
    fail("damaged: its checksum does not fit its values");
  Measured measured;
  try {
    measured = json.value("measured", Measured());
  } catch (const nlohmann::json::exception &) {
    fail("damaged: what was measured is no list of numbers by name");
  }
  for (std::size_t f = 0; f < state.size(); ++f)
    std::ranges::copy(values[f], state[f].values.begin());
  return measured;
}

} // namespace comparisons::study
