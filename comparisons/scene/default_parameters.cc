#include "comparisons/scene/default_parameters.h"

namespace comparisons::scene {

Parameters default_parameters(const std::vector<Declaration> &declarations, const std::map<std::string, Value> &given) {
  Parameters parameters;
  for (const auto &declaration : declarations) {
    const auto found = given.find(declaration.name);
    if (found != given.end())
      parameters.add({declaration, found->second, true, {}});
    else if (declaration.default_value)
      parameters.add({declaration, *declaration.default_value, false, {}});
  }
  return parameters;
}

} // namespace comparisons::scene
