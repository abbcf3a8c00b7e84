// The hash against the published values of FNV-1a, 64 bit (Fowler, Noll & Vo).

#include "comparisons/scene/hash.h"

#include <gtest/gtest.h>

#include <cstring>

namespace {

using comparisons::scene::Hash;

std::string hash_of(const char *bytes) {
  Hash hash;
  hash.add(bytes, std::strlen(bytes));
  return hash.text();
}

TEST(Hash, is_fnv_1a) {
  EXPECT_EQ(hash_of(""), "cbf29ce484222325");
  EXPECT_EQ(hash_of("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(hash_of("foobar"), "85944171f73967e8");
}

TEST(Hash, tells_where_one_text_ends) {
  Hash ab, a_b;
  ab.add("ab");
  ab.add("");
  a_b.add("a");
  a_b.add("b");
  EXPECT_NE(ab.text(), a_b.text());
}

} // namespace
