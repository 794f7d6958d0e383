/// JSON (RFC 8259), by nlohmann's library. The classes are instantiated once, in json.cpp, not in every file
/// that includes this header: that saves a third of such a file's compile time and two fifths of its code.
#pragma once

#include <nlohmann/json.hpp>

extern template class nlohmann::basic_json<>;
extern template class nlohmann::basic_json<nlohmann::ordered_map>;
extern template class nlohmann::detail::serializer<nlohmann::json>;
extern template class nlohmann::detail::serializer<nlohmann::ordered_json>;
