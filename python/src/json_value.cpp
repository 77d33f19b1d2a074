#include <pfaff/python/src/json_value.hpp>

namespace py = pybind11;

namespace pfaff::python {

py::object python_value(const nlohmann::json& json) {
  switch (json.type()) {
    case nlohmann::json::value_t::object: {
      py::dict values;
      for (const auto& [key, value] : json.items()) values[py::str(key)] = python_value(value);
      return values;
    }
    case nlohmann::json::value_t::array: {
      py::list values;
      for (const nlohmann::json& value : json) values.append(python_value(value));
      return values;
    }
    case nlohmann::json::value_t::string:
      return py::str(json.get_ref<const std::string&>());
    case nlohmann::json::value_t::boolean:
      return py::bool_(json.get<bool>());
    case nlohmann::json::value_t::number_integer:
      return py::int_(json.get<std::int64_t>());
    case nlohmann::json::value_t::number_unsigned:
      return py::int_(json.get<std::uint64_t>());
    case nlohmann::json::value_t::number_float:
      return py::float_(json.get<double>());
    default:
      return py::none();
  }
}

}  // namespace pfaff::python
