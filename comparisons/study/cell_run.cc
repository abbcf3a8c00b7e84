#include "comparisons/study/cell_run.h"

#include "comparisons/methods/method_table.h"
#include "comparisons/reports/files.h"

#include <fmt/format.h>

#include <cmath>
#include <new>
#include <stdexcept>

namespace comparisons::study {

namespace {

void fail(reports::Cell &cell, reports::Status status, const std::string &reason) {
  cell.status = status;
  cell.reason = reason;
  cell.errors.clear();
  cell.quantities.clear();
  cell.seconds.clear();
  cell.series.clear();
}

void require_finite(const std::map<std::string, double> &values) {
  for (const auto &[name, value] : values)
    if (!std::isfinite(value))
      throw std::runtime_error(fmt::format("{} is not finite", name));
}

} // namespace

reports::Cell describe_cell(const CellTask &task) {
  reports::Cell cell;
  cell.benchmark = task.scene->benchmark;
  cell.scene = task.scene->name;
  cell.variant = task.variant->label;
  cell.method = task.request->name;
  cell.label = task.request->label;
  cell.level = task.level->text;
  for (const auto &parameter : task.request->parameters.all())
    std::visit([&](const auto &value) { cell.parameters[parameter.declaration.name] = value; }, parameter.value);
  return cell;
}

reports::Cell run_cell(const CellTask &task, bool with_errors, const std::filesystem::path &series_directory) {
  reports::Cell cell = describe_cell(task);
  try {
    task.experiment->run(*task.request, *task.level, with_errors, series_directory, cell);
    require_finite(cell.errors);
    require_finite(cell.quantities);
  } catch (const reports::OutputError &) {
    throw; // not the method's fault: the run cannot keep its results
  } catch (const methods::Refused &refused) {
    fail(cell, reports::Status::refused, refused.what());
  } catch (const std::bad_alloc &) {
    fail(cell, reports::Status::limit, "out of memory");
  } catch (const std::exception &error) {
    // The sparse solvers catch what their C libraries could not allocate, and say so in words.
    const std::string reason = error.what();
    const bool memory = reason.find("out of memory") != std::string::npos;
    fail(cell, memory ? reports::Status::limit : reports::Status::failed, reason);
  } catch (...) {
    fail(cell, reports::Status::failed, "the method threw an exception that is none of the standard library");
  }
  return cell;
}

} // namespace comparisons::study
