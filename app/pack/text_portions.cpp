#include "app/pack/text_portions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace frustumscreen::pack {

namespace {

/// In widths of a narrow letter: about the length of an artifact's short text with its title.
constexpr int max_width = 170;

struct Letter {
    char32_t code = 0;
    std::size_t begin = 0; ///< its first byte
};

std::vector<Letter> letters_of(std::string_view text) {
    std::vector<Letter> letters;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const auto byte = static_cast<std::uint8_t>(text[at]);
        if (byte >= 0x80 && byte < 0xC0 && !letters.empty()) {
            letters.back().code = (letters.back().code << 6U) | (byte & 0x3FU);
        } else {
            letters.push_back({byte < 0x80   ? byte
                               : byte < 0xE0 ? byte & 0x1FU
                               : byte < 0xF0 ? byte & 0x0FU
                                             : byte & 0x07U,
                               at});
        }
    }
    return letters;
}

bool is_one_of(char32_t code, std::u32string_view codes) {
    return codes.find(code) != codes.npos;
}

bool is_space(char32_t code) {
    return is_one_of(code, U" \t\n\r\u00A0\u202F\u3000");
}

/// Letters of Chinese, Japanese and Korean, and their punctuation: Unicode 15, East Asian Width.
bool is_wide(char32_t code) {
    return (code >= 0x1100 && code <= 0x115F) || (code >= 0x2E80 && code <= 0xA4CF) ||
           (code >= 0xAC00 && code <= 0xD7A3) || (code >= 0xF900 && code <= 0xFAFF) ||
           (code >= 0xFE30 && code <= 0xFE4F) || (code >= 0xFF00 && code <= 0xFF60) ||
           (code >= 0x20000 && code <= 0x3FFFD);
}

bool closes(char32_t code) {
    return is_one_of(code, U"\"')]}»›”’」』）】》");
}

bool ends_clause(char32_t code) {
    return is_one_of(code, U",;:–—·،؛、，；：");
}

int width_of(std::span<const Letter> letters) {
    int width = 0;
    for (const Letter& letter : letters) {
        width += is_wide(letter.code) ? 2 : 1;
    }
    return width;
}

/// A full stop may also end an abbreviation or an ordinal number ('um 540 v. Chr.').
bool ends_sentence_with_stop(std::span<const Letter> letters, std::size_t stop, std::size_t next) {
    constexpr std::size_t longest_abbreviation = 2;
    std::size_t before = 0;
    while (before < stop && !is_space(letters[stop - before - 1].code)) {
        ++before;
    }
    const char32_t follows = next < letters.size() ? letters[next].code : U'A';
    const bool goes_on = (follows >= U'a' && follows <= U'z') || (follows >= U'0' && follows <= U'9');
    return before > longest_abbreviation && !goes_on;
}

/// The ends of the sentences as letter indices; the last one is the end of the text.
std::vector<std::size_t> sentence_ends(std::span<const Letter> letters) {
    std::vector<std::size_t> ends;
    for (std::size_t k = 0; k < letters.size(); ++k) {
        const char32_t code = letters[k].code;
        std::size_t end = k + 1;
        while (end < letters.size() && closes(letters[end].code)) {
            ++end;
        }
        std::size_t next = end;
        while (next < letters.size() && is_space(letters[next].code)) {
            ++next;
        }
        const bool apart = next > end || next == letters.size();
        if (code == U'\n' || is_one_of(code, U"。！？｡") || (apart && is_one_of(code, U"!?…؟۔।॥\u037E")) ||
            (apart && code == U'.' && ends_sentence_with_stop(letters, k, next))) {
            ends.push_back(end);
            k = end - 1;
        }
    }
    if (ends.empty() || ends.back() != letters.size()) {
        ends.push_back(letters.size());
    }
    return ends;
}

/// The best end of a part of the sentence near width `wanted` from its beginning, preferably behind a comma. 0:
/// none.
std::size_t best_cut(std::span<const Letter> sentence, int wanted) {
    constexpr int comma_is_worth = 30;
    std::size_t best = 0;
    int best_cost = std::numeric_limits<int>::max();
    int width = 0;
    for (std::size_t k = 0; k + 1 < sentence.size(); ++k) {
        width += is_wide(sentence[k].code) ? 2 : 1;
        const char32_t next = sentence[k + 1].code;
        const bool clause = ends_clause(sentence[k].code);
        const bool between_wide = is_wide(sentence[k].code) && is_wide(next) && !closes(next) &&
                                  !ends_clause(next) && !is_one_of(next, U"。！？｡ーっゃゅょッャュョ々");
        if (!is_space(next) && !between_wide) {
            continue;
        }
        const int cost = std::abs(width - wanted) - (clause ? comma_is_worth : 0);
        if (cost < best_cost) {
            best_cost = cost;
            best = k + 1;
        }
    }
    return best;
}

/// Cuts a sentence that is too long into parts of about equal width; appends their ends to `ends`, the last one the
/// sentence's own.
void add_parts(std::span<const Letter> letters, std::size_t begin, std::size_t end,
               std::vector<std::size_t>& ends) {
    while (true) {
        const std::span<const Letter> rest = letters.subspan(begin, end - begin);
        const int width = width_of(rest);
        const int parts = (width + max_width - 1) / max_width;
        const std::size_t cut = parts > 1 ? best_cut(rest, width / parts) : 0;
        if (cut == 0) {
            ends.push_back(end);
            return;
        }
        begin += cut;
        ends.push_back(begin);
    }
}

} // namespace

std::vector<std::string> portions_of(std::string_view text) {
    const std::vector<Letter> letters = letters_of(text);
    std::vector<std::size_t> ends;
    std::size_t sentence = 0;
    for (const std::size_t end : sentence_ends(letters)) {
        add_parts(letters, sentence, end, ends);
        sentence = end;
    }
    std::vector<std::string> portions;
    std::size_t begin = 0;
    for (std::size_t k = 0; k < ends.size(); ++k) {
        const bool next_fits = k + 1 < ends.size() &&
                               width_of(std::span(letters).subspan(begin, ends[k + 1] - begin)) <= max_width;
        if (next_fits) {
            continue;
        }
        std::size_t from = begin;
        std::size_t to = ends[k];
        begin = ends[k];
        while (from < to && is_space(letters[from].code)) {
            ++from;
        }
        while (to > from && is_space(letters[to - 1].code)) {
            --to;
        }
        if (from < to) {
            const std::size_t last = to < letters.size() ? letters[to].begin : text.size();
            portions.emplace_back(text.substr(letters[from].begin, last - letters[from].begin));
        }
    }
    return portions;
}

std::string portion_key(std::size_t portion) {
    return "description." + std::to_string(portion);
}

double reading_time_s(std::string_view text) {
    constexpr double letters_a_second = 15.0;
    constexpr double wide_letters_a_second = 5.0;
    double time_s = 0.0;
    for (const Letter& letter : letters_of(text)) {
        time_s += 1.0 / (is_wide(letter.code) ? wide_letters_a_second : letters_a_second);
    }
    return time_s;
}

} // namespace frustumscreen::pack
