#include <pfaff/runs/watched/watched_columns.hpp>

#include <limits>
#include <type_traits>
#include <variant>

namespace pfaff {

namespace {
// Units are those of the quantity of a row, which stands in a column of its own.
Column column_of(const QuantityField& field, const std::string& time_unit) {
  Column column{.name = field.name};
  if (field.unit.find("[e]") == std::string::npos) column.unit = unit_of(field, "", time_unit);
  if (field.name == "class" || field.name == "evidence") column.kind = Column::Kind::text;
  return column;
}
Cell cell_of(const QuantityField::Value& value) {
  return std::visit(
      [](const auto& x) -> Cell {
        if constexpr (std::is_same_v<decltype(x), const std::monostate&>) {
          return std::numeric_limits<double>::quiet_NaN();
        } else if constexpr (std::is_same_v<decltype(x), const std::int64_t&>) {
          return static_cast<double>(x);
        } else {
          return x;
        }
      },
      value);
}
}  // namespace

std::vector<Column> watched_columns(bool residuals, const std::string& time_unit) {
  std::vector<Column> columns{{.name = "quantity", .kind = Column::Kind::text},
                              {.name = "unit", .kind = Column::Kind::text}};
  for (const QuantityField& field : quantity_fields())
    if (field.is_of(residuals)) columns.push_back(column_of(field, time_unit));
  return columns;
}

Row watched_row(const WatchedQuantity& quantity, const std::string& name, const std::string& unit,
                bool drifts) {
  Row row{name, unit.empty() ? "1" : unit};
  for (const QuantityField& field : quantity_fields())
    if (field.is_of(quantity.residual))
      row.push_back(drifts ? cell_of(field.value(quantity)) : cell_of(std::monostate()));
  return row;
}

}  // namespace pfaff
