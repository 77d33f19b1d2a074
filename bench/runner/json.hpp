// JSON for reports and records: nlohmann's library, whose classes are compiled once, in json.cpp. Without
// this every file that reads or writes JSON compiles them again, which took a quarter of its time.
#pragma once

#include <string>

// The library's literal "..."_json is an inline function that parses, so that GCC compiles a parser at the
// end of every source that includes the library, for .3 s, whether the literal is used or not. Named by this
// macro it is declared only, and its body becomes that of a function template that nobody calls.
#define JSON_USE_GLOBAL_UDLS 0
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): the name is the library's.
#define _json                      \
  _json(const char*, std::size_t); \
  template <class>                 \
  nlohmann::json unused_literal_json
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
#include <nlohmann/json.hpp>
#undef _json

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
