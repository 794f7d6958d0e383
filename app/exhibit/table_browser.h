/// The pictures on the table to choose from, and the choice among them: layout, pages, fades and dwell in one place.
///
/// The place of the artifact in the prop is empty: its picture fades out as it is chosen, and the previous artifact's
/// picture fades in at its own place. When the reader goes to another side or the page changes, all pictures fade out
/// and in again. A page is turned by resting on the last place, or when an artifact of another page comes into the
/// prop.
///
/// Frames   table T, metres.
/// Time     `now` never goes back.
/// Threads  values; one caller. The constructor lays out all four sides; `step` allocates nothing.
/// Errors   none: a table without space shows nothing.
#pragma once

#include "app/exhibit/dwell.h"
#include "app/exhibit/fade.h"
#include "app/exhibit/table_layout.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::exhibit {

struct PlacedPicture {
    std::optional<std::size_t> artifact; ///< index into the catalogue; nothing: leads to the next page
    TablePlace place;
    double brightness = 0.0; ///< 0..1, a factor on linear light
};

struct PresentedTable {
    std::array<PlacedPicture, max_table_places> places{};
    std::size_t count = 0;
    std::optional<std::size_t> ring; ///< index into `pictures()`: the prop rests on it
    double ring_full = 0.0;          ///< 0..1
    bool changing = false;           ///< a brightness changes by itself
    [[nodiscard]] std::span<const PlacedPicture> pictures() const { return std::span(places).first(count); }
};

class TableBrowser {
public:
    static constexpr Nanoseconds each_way = std::chrono::milliseconds(250); ///< fade out, or fade in
    static constexpr double dimmed = 0.12; ///< light of a picture under a sign

    explicit TableBrowser(const TableSetUp& set_up);

    struct Input {
        std::size_t artifact = 0;                       ///< in the prop, or about to be
        int quarter_turns = 0;                          ///< the reader's side
        std::optional<typography::TablePolygon> shadow; ///< hidden_by_prop from the lens
        std::optional<glm::dvec2> prop_m;               ///< standing_place, while the prop is known
        bool choose = false;                            ///< pressed: chooses the picture whose ring has begun
        std::optional<typography::TablePolygon> sign;   ///< advice as a picture; table pictures under it dim
    };
    /// Returns the artifact that was chosen by resting on its picture, in that step only.
    [[nodiscard]] std::optional<std::size_t> step(MonotonicTime now, const Input& input);
    /// Sets whether the artifact can be chosen: its picture appears or disappears.
    void offer(std::size_t artifact, bool offered) {
        left_out_[artifact] = !offered;
        choosable_holds_ = false;
    }
    [[nodiscard]] const PresentedTable& presented() const { return presented_; }
    /// True if the prop is on a picture that resting chooses.
    [[nodiscard]] bool prop_is_on_picture() const { return on_picture_ || presented_.ring; }
    /// True if the latest step chose an artifact or turned the page.
    [[nodiscard]] bool chose() const { return chose_; }
    /// The places that captions must not overlap: those of this side, empty ones too.
    [[nodiscard]] std::span<const typography::TableRectangle> obstacles() const {
        return std::span(obstacles_).first(obstacle_count_);
    }

private:
    /// A side and a page of it, as one number for the fade.
    struct Arrangement {
        std::size_t side = 0;
        std::size_t page = 0;
        [[nodiscard]] std::size_t number() const { return 4 * page + side; }
        [[nodiscard]] static Arrangement of(std::size_t number) { return {number % 4, number / 4}; }
    };
    void turn_to_page_of(std::size_t artifact, std::size_t side);
    void lay_out(const Arrangement& arrangement, std::size_t artifact);
    void lighten(MonotonicTime now, const Input& input, const Faded& faded);
    void note_choosable(std::size_t artifact);
    [[nodiscard]] bool is_under_sign(MonotonicTime now, const Input& input, std::size_t picture);
    [[nodiscard]] bool is_on_picture(const std::optional<glm::dvec2>& prop_m) const;

    /// True if the place is empty: its artifact is in the prop, or left out.
    [[nodiscard]] bool empty(const PlacedPicture& picture, std::size_t artifact) const {
        return picture.artifact && (*picture.artifact == artifact || left_out_[*picture.artifact]);
    }

    std::array<TableLayout, 4> layouts_;
    std::vector<bool> left_out_; ///< by artifact
    std::size_t page_ = 0;
    std::optional<std::size_t> artifact_; ///< artifact of `page_` and the choosable pictures
    std::size_t side_ = 0;
    std::optional<Fade> fade_;            ///< from the first step on
    std::optional<std::size_t> laid_out_; ///< the arrangement on the table
    MonotonicTime last_;
    std::array<double, max_table_places> presence_{};                        ///< 0: the place is empty
    std::array<double, max_table_places> under_sign_{};                      ///< 1: dimmed
    std::array<std::optional<MonotonicTime>, max_table_places> signed_at_{}; ///< when a sign last lay on it
    Dwell dwell_;
    std::array<typography::TableRectangle, max_table_places> choosable_{};
    std::array<std::size_t, max_table_places> choosable_places_{};
    std::size_t choosable_count_ = 0;
    bool choosable_holds_ = false; ///< the choosable pictures match the table
    bool on_picture_ = false;
    std::array<typography::TableRectangle, max_table_places> obstacles_{};
    std::size_t obstacle_count_ = 0;
    PresentedTable presented_;
    bool chose_ = false;
};

} // namespace frustumscreen::exhibit
