/// The section `states` of a pack: the same artifact before, after and reconstructed, in the order in which a visitor pins
/// them beside each other.
///
/// A state is the artifact at the end of a behaviour, or at rest, without the cells that are hidden, and in the colours of a
/// layer or its own. So it needs no part of its own.
///
/// Errors   one line: data that FORMAT.md does not allow. A pack without the section is no error: it has no states.
/// Threads  pure; any.
#pragma once

#include "app/pack/pack.h"
#include "firmware_host/base/result.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::pack {

inline constexpr std::string_view states_section = "states";
/// At most settings::max_windows windows lie on a table: one for the artifact as the prop shows it, and one for each
/// state.
inline constexpr std::size_t max_states = 5;

struct PackState {
    std::string name;
    std::vector<PackLabel> titles;          ///< what the visitor reads ("As found"), in each language
    std::vector<std::size_t> hidden{};      ///< indices of cells that are not there, ascending
    std::optional<std::size_t> behaviour{}; ///< index of the behaviour at whose end it is; none: at rest
    std::optional<std::size_t> layer{};     ///< index into PackTorches::layers; none: its own colours

    [[nodiscard]] bool operator==(const PackState&) const = default;
};

/// From the manifest alone.
[[nodiscard]] Result<std::vector<PackState>> states_of(const PackDescription& pack);
/// Call once for a pack, after put_torches and put_world; nothing is put for no state. Errors: what states_of refuses.
[[nodiscard]] Result<void> put_states(Pack& pack, std::vector<PackState> states);

} // namespace frustumscreen::pack
