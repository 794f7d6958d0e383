/// JSON, by nlohmann's library (JSON: RFC 8259). Each file that includes this takes its classes from json.cpp, rather than compiling them
/// anew: a third of such a file's time, and two fifths of its code.
#pragma once

#include <nlohmann/json.hpp>

extern template class nlohmann::basic_json<>;
extern template class nlohmann::basic_json<nlohmann::ordered_map>;
extern template class nlohmann::detail::serializer<nlohmann::json>;
extern template class nlohmann::detail::serializer<nlohmann::ordered_json>;
