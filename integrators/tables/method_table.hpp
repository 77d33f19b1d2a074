// Methods that are tables of coefficients, or maps written as text, in files: what `--integrator FILE.toml`
// names.
//
// A file is read once. The order conditions of a table are checked while it is read, what it keeps is
// computed from its numbers, and the method is registered under the name that the file gives it, so that it
// is run, verified and compared like one of the tree.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pfaff/core/integrator.hpp>
#include <pfaff/core/text/plugin_files.hpp>
#include <pfaff/integrators/order_conditions/order_condition.hpp>
#include <pfaff/integrators/tables/table_document.hpp>

namespace pfaff {

/// A method made of a file.
class MethodTable : public MethodPlugin {
 public:
  /// The file and what stood in it when it was read.
  [[nodiscard]] const text::FileContents& files() const { return files_; }
  /// The absolute path of the file.
  [[nodiscard]] const std::string& path() const { return files_.front().first; }
  /// The conditions that were checked; `kind` is empty where there are none.
  [[nodiscard]] const OrderTheory& theory() const { return theory_; }
  /// The registered methods that the table names, with their settings.
  [[nodiscard]] virtual std::vector<std::pair<const Plugin*, Assignments>> rests_on() const { return {}; }

 protected:
  MethodTable(MethodDescriptor descriptor, std::vector<Parameter> parameters, const std::type_info& type,
              const TableDocument& document, OrderTheory theory)
      : MethodPlugin(std::move(descriptor), std::move(parameters), type, std::source_location::current()),
        files_{{document.path(), document.contents()}},
        theory_(std::move(theory)) {}

 private:
  text::FileContents files_;
  OrderTheory theory_;
};

/// Reads a file, without registering what it holds. InputError for a file that is no table of coefficients,
/// or one whose conditions do not hold.
std::unique_ptr<const MethodTable> read_method_table(const std::string& path);

/// True for the name of a file that a table of coefficients is expected in, where names of other things may
/// stand too: it ends in ".toml", and what the file holds is not known to be something else, TOML without a
/// key `kind`.
bool names_method_table(const std::string& path);

/// The registered method of that name or, where it ends in ".toml", the method of that file, which is read
/// and registered the first time. InputError for an unknown name, a file that is refused, one whose name is
/// taken, and one that has changed since it was registered. Calls of several threads wait for each other.
const MethodPlugin& integrator_named(const std::string& name);

// What the kinds of tables share, used by their readers.

/// The part of a table that every kind has: name, title, reference, description and precision.
struct TableHead {
  MethodDescriptor descriptor;
  Quad precision = precision_of_quad_coefficients;
};

/// Checks that the conditions show the order that the table states, no less and no more. `conditions` reach
/// one order further than that, where the theory does. InputError with the condition and its residual.
void require_order(const TableDocument& document, const TableHead& head,
                   const std::vector<OrderCondition>& conditions);

/// Checks that a processor could lift the kernel, which is under `key`, to the order that the table states.
void require_effective_order(const TableDocument& document, const TableHead& head, const std::string& key,
                             const std::vector<OrderCondition>& conditions);

/// What the numbers keep, `kept`, unless the table has a list `preserves`. InputError for a claim in that
/// list that the numbers do not bear out; `why` says for a claim which condition fails and by how much.
std::vector<Claim> kept_claims(TableDocument& document, std::vector<Claim> kept,
                               const std::function<std::string(Claim)>& why);

/// "off by 1.2e-09; expected at most 1e-33"
std::string residual_in_words(const OrderCondition& condition, const Quad& precision);

namespace detail {
using TableReader = std::unique_ptr<const MethodTable> (*)(TableDocument&, TableHead);
void register_table_kind(std::vector<std::string> names, TableReader read);

template <class Unit, class... M>
class TableKindIn : private CodeOf<Instance<M>...> {
 public:
  TableKindIn(std::vector<std::string> names, TableReader read) {
    register_table_kind(std::move(names), read);
  }
};
template <class... M>
class TableKindIn<InDouble, M...> : private CodeOf<Instance<M>...> {
 public:
  TableKindIn(std::initializer_list<const char*> /*names*/, TableReader /*read*/) {}
};
}  // namespace detail

/// Registers the reader of one kind of table under the names that files call it by; M are the methods that it
/// makes.
template <class... M>
using TableKind = detail::TableKindIn<detail::ThisUnit, M...>;

/// A table whose method is a struct M, filled when the file was read.
template <class M>
class TableOf final : public MethodTable {
 public:
  TableOf(MethodDescriptor descriptor, const TableDocument& document, OrderTheory theory, M method)
      : MethodTable(std::move(descriptor), parameters_of<M>(), typeid(M), document, std::move(theory)),
        method_(std::move(method)) {
    detail::check_method_members<M>();
  }
  [[nodiscard]] std::unique_ptr<MethodInstance> make(const Assignments& assignments) const override {
    M method = method_;
    assign_all(parameters(), &method, assignments, "integrator " + name());
    return std::make_unique<detail::Instance<M>>(*this, std::move(method));
  }
  [[nodiscard]] std::vector<Assignments> instances(bool /*full*/) const override { return {{}}; }

 private:
  M method_;
};

}  // namespace pfaff
