#include "app/watch/ladder_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <iterator>
#include <limits>
#include <vector>

namespace frustumscreen::watch {

namespace {

constexpr std::string_view name = "frustumscreen-ladder-2";
constexpr std::int64_t nothing = -1;
constexpr std::int64_t no_limit = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t max_milliseconds = 31'557'600'000'000; // a thousand years

std::uint64_t fnv1a(std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char each : text) {
        hash = (hash ^ static_cast<unsigned char>(each)) * 0x100000001b3U;
    }
    return hash;
}

template <typename Value> std::int64_t number_of(const std::optional<Value>& value) {
    return value ? static_cast<std::int64_t>(*value) : nothing;
}

/// The numbers in the order in which `take_memory` reads them.
std::vector<std::int64_t> numbers_of(const KeptMemory& kept) {
    const LadderMemory& memory = kept.memory;
    std::vector<std::int64_t> numbers{static_cast<std::int64_t>(kept.writes),
                                      static_cast<std::int64_t>(kept.boot),
                                      kept.since_boot.count(),
                                      memory.awake.count(),
                                      static_cast<std::int64_t>(memory.mode),
                                      memory.climb,
                                      memory.returns,
                                      memory.tried,
                                      memory.given_up,
                                      number_of(memory.cause),
                                      number_of(memory.latest),
                                      memory.latest_at.count()};
    for (const std::optional<Step>& step : memory.helped) {
        numbers.push_back(number_of(step));
    }
    for (const std::optional<Awake>& at : memory.reboots) {
        numbers.push_back(at ? at->count() : nothing);
    }
    return numbers;
}

/// Takes whole numbers from the front of a text; after an invalid one all reads fail.
class Numbers {
public:
    explicit Numbers(std::string_view text) : rest_(text) {}
    [[nodiscard]] bool are_sound() const { return are_sound_; }
    [[nodiscard]] bool at_end() const { return rest_.empty(); }

    std::int64_t take(std::int64_t least, std::int64_t most) {
        std::int64_t value = 0;
        const char* const end = rest_.data() + rest_.size();
        const auto [stop, error] = std::from_chars(rest_.data(), end, value);
        const bool ends = stop != end && *stop == ' ';
        are_sound_ = are_sound_ && error == std::errc{} && ends && value >= least && value <= most;
        rest_.remove_prefix(are_sound_ ? static_cast<std::size_t>(stop - rest_.data()) + 1 : rest_.size());
        return are_sound_ ? value : 0;
    }
    std::uint8_t byte(std::int64_t most) { return static_cast<std::uint8_t>(take(0, most)); }
    Awake awake(Awake latest) { return Awake(take(0, latest.count())); }
    /// An enumerator, one of `count`; nullopt for -1.
    template <typename Enum> std::optional<Enum> one_of(std::size_t count) {
        const std::int64_t value = take(nothing, static_cast<std::int64_t>(count) - 1);
        return value == nothing ? std::nullopt : std::optional(static_cast<Enum>(value));
    }

private:
    std::string_view rest_;
    bool are_sound_ = true;
};

constexpr std::int64_t all_bits(std::size_t count) {
    return (std::int64_t{1} << count) - 1;
}

/// Latest first, and none later than `awake`.
void take_reboots(Numbers& numbers, LadderMemory& memory) {
    Awake latest = memory.awake;
    for (std::optional<Awake>& at : memory.reboots) {
        const std::int64_t value = numbers.take(nothing, latest.count());
        at = value == nothing ? std::nullopt : std::optional(Awake(value));
        latest = at ? *at : Awake(nothing);
    }
}

std::optional<KeptMemory> take_memory(std::string_view text) {
    Numbers numbers(text);
    KeptMemory kept;
    LadderMemory& memory = kept.memory;
    kept.writes = static_cast<std::uint64_t>(numbers.take(0, no_limit));
    kept.boot = static_cast<std::uint64_t>(numbers.take(0, no_limit));
    kept.since_boot = numbers.awake(Awake(max_milliseconds));
    memory.awake = numbers.awake(Awake(max_milliseconds));
    memory.mode = static_cast<Mode>(numbers.byte(mode_count - 1));
    memory.climb = numbers.byte(Ladder::highest_climb);
    memory.returns = numbers.byte(Ladder::max_returns);
    memory.tried = numbers.byte(all_bits(step_count));
    memory.given_up = numbers.byte(all_bits(cause_count));
    memory.cause = numbers.one_of<Cause>(cause_count);
    memory.latest = numbers.one_of<Step>(step_count);
    memory.latest_at = numbers.awake(memory.awake);
    for (std::optional<Step>& step : memory.helped) {
        step = numbers.one_of<Step>(step_count);
    }
    take_reboots(numbers, memory);
    return numbers.are_sound() && numbers.at_end() ? std::optional(kept) : std::nullopt;
}

} // namespace

std::string slot_of(const KeptMemory& kept) {
    std::string body;
    for (const std::int64_t number : numbers_of(kept)) {
        fmt::format_to(std::back_inserter(body), "{} ", number);
    }
    std::string slot = fmt::format("{} {:016x} {}", name, fnv1a(body), body);
    assert(slot.size() < slot_bytes);
    slot.resize(slot_bytes, ' ');
    slot.back() = '\n';
    return slot;
}

std::optional<KeptMemory> read_slot(std::string_view slot) {
    constexpr std::size_t hash_digits = 16;
    const std::size_t body_begins = name.size() + 1 + hash_digits + 1;
    if (slot.size() != slot_bytes || !slot.starts_with(name) || slot.back() != '\n') {
        return std::nullopt;
    }
    slot.remove_suffix(1);
    const std::string_view body = slot.substr(body_begins, slot.find_last_not_of(' ') + 2 - body_begins);
    if (slot.substr(0, body_begins) != fmt::format("{} {:016x} ", name, fnv1a(body))) {
        return std::nullopt;
    }
    return take_memory(body);
}

std::optional<KeptMemory> read_slots(std::string_view file) {
    std::optional<KeptMemory> latest;
    for (std::size_t begin = 0; begin + slot_bytes <= file.size(); begin += slot_bytes) {
        const std::optional<KeptMemory> kept = read_slot(file.substr(begin, slot_bytes));
        latest = kept && (!latest || kept->writes > latest->writes) ? kept : latest;
    }
    return latest;
}

LadderMemory remembered(const KeptMemory& kept, std::uint64_t boot, Awake since_boot) {
    LadderMemory memory = kept.memory;
    const bool is_same = boot == kept.boot && since_boot >= kept.since_boot;
    memory.awake += is_same ? since_boot - kept.since_boot : since_boot;
    return memory;
}

std::uint64_t number_of_boot(std::string_view boot_id) {
    return fnv1a(boot_id) >> 1U;
}

} // namespace frustumscreen::watch
