#include "app/watch/cause.h"
#include "app/watch/step.h"

#include <array>

namespace frustumscreen::watch {

namespace {

struct Words {
    std::string_view word, sentence;
};
constexpr std::array<Words, cause_count> causes{{
    {"safe_picture_fails", "the safe picture does not appear"},
    {"keeps_ending", "the exhibit's program ends again and again"},
    {"no_picture", "the exhibit shows no live picture"},
    {"nothing_to_show", "no object of the set can be shown"},
    {"memory_short", "the computer runs out of memory"},
    {"device_silent", "the tracker is plugged in but sends nothing"},
}};
constexpr std::array<Words, step_count> steps{{
    {"restart_exhibit", "the exhibit is started again"},
    {"reset_device", "the tracker's USB port is switched off and on"},
    {"last_good_set", "the exhibit goes back to the last good set of objects"},
    {"draw_plainly", "the exhibit draws on the processor, without the graphics card"},
    {"built_in", "the exhibit shows the object that is built in"},
    {"safe_picture", "words for the staff are shown in place of the exhibit"},
    {"reboot", "the computer is started again"},
    {"return", "the exhibit goes back to its own set"},
}};
constexpr std::array<Words, mode_count> modes{{
    {"normal", "lets the exhibit run as set up"},
    {"last_good_set", "lets the exhibit show the last good set of packs"},
    {"plain", "lets the exhibit draw on the processor alone"},
    {"built_in", "lets the exhibit show a built-in artifact"},
    {"safe", "shows the safe picture, with words for the staff"},
}};

template <typename Enum, std::size_t count>
std::optional<Enum> named(const std::array<Words, count>& words, std::string_view word) {
    for (std::size_t k = 0; k < count; ++k) {
        if (words[k].word == word) {
            return static_cast<Enum>(k);
        }
    }
    return std::nullopt;
}

} // namespace

std::string_view word_of(Cause cause) {
    return causes.at(static_cast<std::size_t>(cause)).word;
}
std::optional<Cause> cause_named(std::string_view word) {
    return named<Cause>(causes, word);
}
std::string_view sentence_of(Cause cause) {
    return causes.at(static_cast<std::size_t>(cause)).sentence;
}
std::string_view sentence_of(const std::optional<Cause>& cause) {
    return cause ? sentence_of(*cause) : "ten minutes without a fault";
}
std::string_view word_of(Step step) {
    return steps.at(static_cast<std::size_t>(step)).word;
}
std::optional<Step> step_named(std::string_view word) {
    return named<Step>(steps, word);
}
std::string_view sentence_of(Step step) {
    return steps.at(static_cast<std::size_t>(step)).sentence;
}
std::string_view word_of(Mode mode) {
    return modes.at(static_cast<std::size_t>(mode)).word;
}
std::string_view sentence_of(Mode mode) {
    return modes.at(static_cast<std::size_t>(mode)).sentence;
}
std::optional<Mode> mode_named(std::string_view word) {
    return named<Mode>(modes, word);
}

} // namespace frustumscreen::watch
