// Finding members of a type by their names, whatever their kind and signature, inherited or not.
#include <gtest/gtest.h>

#include <pfaff/core/registry/member_names.hpp>

namespace order_names {
PFAFF_MEMBER_NAME(order)
}  // namespace order_names

namespace {

struct None {
  [[maybe_unused]] int orders = 0;
};
struct Function {
  [[nodiscard]] int order() const { return 1; }
};
struct Static {
  static int order(int x) { return x; }
};
struct Template {
  template <class T>
  T order(const T& x) const {
    return x;
  }
};
struct OverloadedOrder {
  static int order(int x) { return x; }
  static double order(double x) { return x; }
};
struct Data {
  int order = 1;
};
struct StaticData {
  static constexpr int order = 1;
};
struct Type {
  struct order {};
};
struct Inherited : Function {};
class PrivateOrder {
  [[maybe_unused]] void order() {}
};

TEST(MemberNames, AnyMemberIsFoundByItsNameAlone) {
  EXPECT_FALSE(order_names::has_order<None>);
  EXPECT_TRUE(order_names::has_order<Function>);
  EXPECT_TRUE(order_names::has_order<Static>);
  EXPECT_TRUE(order_names::has_order<Template>);
  EXPECT_TRUE(order_names::has_order<OverloadedOrder>);
  EXPECT_TRUE(order_names::has_order<Data>);
  EXPECT_TRUE(order_names::has_order<StaticData>);
  EXPECT_TRUE(order_names::has_order<Type>);
  EXPECT_TRUE(order_names::has_order<Inherited>);
  EXPECT_TRUE(order_names::has_order<PrivateOrder>);
}

TEST(MemberNames, DataIsToldFromTheRest) {
  EXPECT_FALSE(order_names::names_order<None>);
  EXPECT_TRUE(order_names::names_order<Function>);
  EXPECT_TRUE(order_names::names_order<Static>);
  EXPECT_TRUE(order_names::names_order<Template>);
  EXPECT_TRUE(order_names::names_order<OverloadedOrder>);
  EXPECT_FALSE(order_names::names_order<Data>);
  EXPECT_FALSE(order_names::names_order<StaticData>);
  EXPECT_TRUE(order_names::names_order<Inherited>);
}

}  // namespace
