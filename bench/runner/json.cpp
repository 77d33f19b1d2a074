#include <pfaff/bench/runner/json.hpp>

template class nlohmann::basic_json<>;
template class nlohmann::detail::serializer<nlohmann::json>;
template class nlohmann::detail::lexer<nlohmann::json, pfaff::detail::JsonInText>;
template class nlohmann::detail::parser<nlohmann::json, pfaff::detail::JsonInText>;
template class nlohmann::detail::lexer<nlohmann::json, pfaff::detail::JsonInStream>;
template class nlohmann::detail::parser<nlohmann::json, pfaff::detail::JsonInStream>;
