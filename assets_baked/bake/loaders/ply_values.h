/// Reads the values after a PLY file's header.
///
/// Errors   throws Refusal naming the element and its row.
#pragma once

#include "assets_baked/bake/loaders/ply_header.h"
#include "assets_baked/bake/loaders/text.h"
#include "firmware_host/base/file.h"

#include <cmath>

namespace frustumscreen {

/// Reads them one by one, text or binary.
class PlyValues {
public:
    PlyValues(ByteView file, const PlyHeader& header)
        : header_(header), data_(file.subspan(header.size)), words_(as_text(data_)) {}

    double next(PlyType type, const PlyElement& element, std::uint64_t row) {
        if (header_.is_text) {
            return next_word(element, row);
        }
        if (size_of(type) > data_.size() - position_) {
            refuse_end(element, row);
        }
        const double value = binary(type);
        position_ += size_of(type);
        return value;
    }
    /// The next value as a length or an index.
    std::int64_t next_whole(PlyType type, const PlyElement& element, std::uint64_t row) {
        const double value = next(type, element, row);
        if (!(std::abs(value) < 9e15) || value != std::floor(value)) {
            refuse_damage("{} {}: a whole number is expected, not {}", element.name, row, value);
        }
        return static_cast<std::int64_t>(value);
    }

    /// The bytes of the file that are read.
    [[nodiscard]] std::size_t passed() const {
        return header_.size + (header_.is_text ? words_.position() : position_);
    }
    /// At most this many rows of the element can follow.
    [[nodiscard]] std::uint64_t possible_rows(const PlyElement& element) const {
        std::size_t least = 0; // bytes of a row; lists may be empty
        for (const PlyProperty& property : element.properties) {
            least += header_.is_text ? 2 : size_of(property.list_count.value_or(property.type));
        }
        const std::size_t left = data_.size() - (header_.is_text ? words_.position() : position_);
        return std::min<std::uint64_t>(element.count, left / std::max<std::size_t>(least, 1));
    }

private:
    [[noreturn]] static void refuse_end(const PlyElement& element, std::uint64_t row) {
        refuse_cut_short("at {} {} of {}", element.name, row, element.count);
    }
    double next_word(const PlyElement& element, std::uint64_t row) {
        const std::string_view word = words_.next();
        if (word.empty()) {
            refuse_end(element, row);
        }
        const std::optional<double> number = number_from(word);
        if (!number) {
            refuse_damage("{} {}: a number is expected, not \"{}\"", element.name, row, word.substr(0, 40));
        }
        return *number;
    }
    [[nodiscard]] double binary(PlyType type) const {
        switch (type) {
        case PlyType::I8:
            return load<std::int8_t>(data_, position_, header_.order);
        case PlyType::U8:
            return load<std::uint8_t>(data_, position_, header_.order);
        case PlyType::I16:
            return load<std::int16_t>(data_, position_, header_.order);
        case PlyType::U16:
            return load<std::uint16_t>(data_, position_, header_.order);
        case PlyType::I32:
            return load<std::int32_t>(data_, position_, header_.order);
        case PlyType::U32:
            return load<std::uint32_t>(data_, position_, header_.order);
        case PlyType::I64:
            return static_cast<double>(load<std::int64_t>(data_, position_, header_.order));
        case PlyType::U64:
            return static_cast<double>(load<std::uint64_t>(data_, position_, header_.order));
        case PlyType::F32:
            return static_cast<double>(load<float>(data_, position_, header_.order));
        default:
            return load<double>(data_, position_, header_.order);
        }
    }

    const PlyHeader& header_;
    ByteView data_;
    std::size_t position_ = 0;
    WordReader words_;
};

} // namespace frustumscreen
