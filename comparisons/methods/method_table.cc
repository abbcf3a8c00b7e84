#include "comparisons/methods/method_table.h"

#include "comparisons/methods/fem.h"
#include "comparisons/methods/particle_methods.h"

namespace comparisons::methods {

std::vector<Method> method_table() { return {strong(), weak1(), weak2(), hybrid(), mixed(), fem()}; }

} // namespace comparisons::methods
