#pragma once

#include "comparisons/reports/results.h"
#include "comparisons/scene/scene.h"

#include "meshless/dynamics/named_field.h"

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>

namespace comparisons::study {

/// A checkpoint that cannot be used; the message names the file and what is wrong with it.
class CheckpointError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// What a run's numbers depend on, as a hash (FNV-1a, 64 bit, hexadecimal): benchmark, problem, material, effects with
/// their keys, [time] without `checkpoint_every` and `resume`, the method with its keys, level and seed. Everything
/// else (title, label, output, threads, repeats, limits) may change between a run and its continuation.
std::string identity_of(const scene::Scene &scene, const scene::ProblemVariant &variant,
                        const scene::MethodRequest &request, const scene::Level &level);

/// Path below the results folder: "checkpoints/<benchmark>-<scene>-...cbor".
std::filesystem::path checkpoint_file(const reports::Cell &cell);

/// Quantities of snapshots that were taken before the checkpoint.
using Measured = std::map<std::string, double>;

/// Writes a state as CBOR (RFC 8949), complete or not at all: {"format": "petrov checkpoint", "schema": 1, "identity",
/// "checksum", "measured": {name: number}, "fields": {name: [numbers]}}, all numbers to the last bit.
/// @throws reports::OutputError
void write_checkpoint(const std::filesystem::path &path, const std::string &identity,
                      const meshless::dynamics::State &state, const Measured &measured);

/// Fills the state's arrays; its names and lengths must be those of the file.
/// @throws CheckpointError for a file that is truncated, is no checkpoint, has another schema, belongs to another
/// scene,
///   or does not fit the state; the state is then unchanged
Measured read_checkpoint(const std::filesystem::path &path, const std::string &identity,
                         const meshless::dynamics::State &state);
/// The same from bytes in memory; `name` stands for the file in messages.
Measured parse_checkpoint(const std::string &bytes, const std::string &name, const std::string &identity,
                          const meshless::dynamics::State &state);

} // namespace comparisons::study
