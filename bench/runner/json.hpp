// JSON for reports and records: nlohmann's library, whose classes are compiled once, in json.cpp. Without
// this every file that reads or writes JSON compiles them again, which took a quarter of its time.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace pfaff::detail {
using JsonInText = nlohmann::detail::iterator_input_adapter<std::string::const_iterator>;
using JsonInStream = nlohmann::detail::input_stream_adapter;
}  // namespace pfaff::detail

extern template class nlohmann::basic_json<>;
extern template class nlohmann::detail::serializer<nlohmann::json>;
extern template class nlohmann::detail::lexer<nlohmann::json, pfaff::detail::JsonInText>;
extern template class nlohmann::detail::parser<nlohmann::json, pfaff::detail::JsonInText>;
extern template class nlohmann::detail::lexer<nlohmann::json, pfaff::detail::JsonInStream>;
extern template class nlohmann::detail::parser<nlohmann::json, pfaff::detail::JsonInStream>;
