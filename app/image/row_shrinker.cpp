#include "app/image/row_shrinker.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::image {

namespace {

constexpr std::size_t entries = 1U << 16U;

/// A table of the nearest sRGB code of linear light; its steps are a twentieth of a code where codes are
/// closest, near black.
std::vector<std::uint8_t> code_table() {
    std::vector<std::uint8_t> codes(entries);
    for (std::size_t k = 0; k < entries; ++k) {
        codes[k] = srgb8_from_linear(static_cast<double>(k) / static_cast<double>(entries - 1));
    }
    return codes;
}

/// The texel of the mean light and alpha in `sum`.
glm::u8vec4 texel_of(const glm::vec4& sum) {
    static const std::vector<std::uint8_t> codes = code_table();
    const auto code = [&](float light) {
        const float place = std::clamp(light, 0.0F, 1.0F) * static_cast<float>(entries - 1);
        return codes[static_cast<std::size_t>(std::lround(place))];
    };
    return {code(sum.r), code(sum.g), code(sum.b),
            static_cast<std::uint8_t>(std::lround(std::clamp(sum.a, 0.0F, 255.0F)))};
}

} // namespace

glm::ivec2 halved_size(const glm::ivec2& size, int halvings) {
    glm::ivec2 halved = size;
    for (int k = 0; k < halvings; ++k) {
        halved = glm::max(halved / 2, glm::ivec2(1));
    }
    return halved;
}

std::vector<RowShrinker::Covered> RowShrinker::coverage(int size, int half) {
    std::vector<Covered> covered(static_cast<std::size_t>(half));
    const double span = static_cast<double>(size) / half; // 2, or up to 3 if the size is odd
    for (int k = 0; k < half; ++k) {
        Covered& c = covered[static_cast<std::size_t>(k)];
        const double begin = k * span;
        const double end = begin + span;
        c.first = static_cast<int>(begin);
        for (int t = c.first; t < size && t < end && c.count < 3; ++t) {
            const double part = std::fmin(end, t + 1.0) - std::fmax(begin, t);
            c.share[static_cast<std::size_t>(c.count++)] = static_cast<float>(part / span);
        }
    }
    return covered;
}

RowShrinker::RowShrinker(const glm::ivec2& size, int halvings) {
    for (int k = 0; k < halvings; ++k) {
        const glm::ivec2 whole = halved_size(size, k);
        const glm::ivec2 half = halved_size(size, k + 1);
        const std::vector<glm::vec4> sums(static_cast<std::size_t>(half.x), glm::vec4(0.0F));
        halvings_.push_back({.columns = coverage(whole.x, half.x),
                             .rows = coverage(whole.y, half.y),
                             .arrived = 0,
                             .finished = 0,
                             .sums = sums,
                             .made = std::vector<glm::u8vec4>(sums.size())});
    }
    const glm::ivec2 shrunk = halved_size(size, halvings);
    shrunk_ = Image8(shrunk.x, shrunk.y);
}

void RowShrinker::add(std::span<const glm::u8vec4> row) {
    add(row, 0);
}

void RowShrinker::add_share(std::span<const glm::u8vec4> row, float share,
                            const std::vector<Covered>& columns, std::vector<glm::vec4>& sums) {
    const std::array<float, 256>& linear = linear_from_srgb8();
    for (std::size_t x = 0; x < columns.size(); ++x) {
        const Covered& column = columns[x];
        glm::vec4 sum = sums[x];
        for (int i = 0; i < column.count; ++i) {
            const glm::u8vec4& texel =
                row[static_cast<std::size_t>(column.first) + static_cast<std::size_t>(i)];
            sum += share * column.share[static_cast<std::size_t>(i)] *
                   glm::vec4(linear[texel.r], linear[texel.g], linear[texel.b], static_cast<float>(texel.a));
        }
        sums[x] = sum;
    }
}

void RowShrinker::add(std::span<const glm::u8vec4> row, std::size_t k) {
    if (k == halvings_.size()) {
        keep(row);
        return;
    }
    Halving& halving = halvings_[k];
    const auto arrived = static_cast<int>(halving.arrived++);
    // A row may lie in two rows of the half: it ends one, and begins the next.
    while (halving.finished < halving.rows.size() && halving.rows[halving.finished].first <= arrived) {
        const Covered& covered = halving.rows[halving.finished];
        add_share(row, covered.share.at(static_cast<std::size_t>(arrived - covered.first)), halving.columns,
                  halving.sums);
        if (arrived + 1 < covered.first + covered.count) {
            return;
        }
        std::transform(halving.sums.begin(), halving.sums.end(), halving.made.begin(), texel_of);
        std::fill(halving.sums.begin(), halving.sums.end(), glm::vec4(0.0F));
        ++halving.finished;
        add(halving.made, k + 1);
    }
}

void RowShrinker::keep(std::span<const glm::u8vec4> row) {
    const std::size_t count = std::min(row.size(), shrunk_.texels.size() - kept_);
    std::copy_n(row.begin(), count, shrunk_.texels.begin() + static_cast<std::ptrdiff_t>(kept_));
    kept_ += count;
}

} // namespace frustumscreen::image
