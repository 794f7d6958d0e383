/// What lies on the table to choose from, as pictures: the artifacts' small pictures with their titles, the place that leads on,
/// and the ring around the prop.
///
/// A pack without a table picture shows an outlined square with its title in it.
///
/// Frames   table T, metres.
/// Threads  the render thread, with the display's context current. `place` allocates nothing.
/// Errors   the driver has no memory. A pack whose picture or titles cannot be read lies there as a square, and a note says why.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/render/gpu_store.h"
#include "app/settings/settings.h"
#include "app/show/on_table.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen {

class TableShow {
public:
    struct Request {
        std::vector<std::filesystem::path> packs; ///< in the catalogue's order
        bool all_languages = false;               ///< a button changes the language
    };
    TableShow() = default; ///< shows nothing
    [[nodiscard]] static Result<TableShow> load(const Settings& settings, const Request& request,
                                                GpuStore& store);

    /// `shadow`: the prop's.
    void place(const Presentation& presentation, const std::optional<TablePolygon>& shadow,
               OnTable& on_table) const;
    /// The picture that grows into the prop's place; on the prop, not hidden by it.
    void place_stand_in(const PresentedStandIn& stand_in, OnTable& on_table) const;
    /// One of each kind of picture, so that drivers compile for them before the first frame.
    void place_samples(const glm::dvec2& at_m, OnTable& on_table) const;

    [[nodiscard]] std::uint64_t planned_gpu_bytes() const { return planned_gpu_bytes_; }
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

private:
    struct Picture {
        TextureId texture = TextureId::None;
        glm::dvec2 size{1.0}; ///< of any unit
    };
    struct Title {
        TextureId texture = TextureId::None;
        glm::dvec2 size_m{0.0};
    };
    struct Card {
        Picture picture; ///< no texture: the pack has none
        std::vector<std::string> languages;
        std::vector<Title> titles; ///< by language
    };
    struct Loader;

    void place_card(const PlacedPicture& placed, const Presentation& presentation, OnTable& on_table) const;
    void place_title(const PlacedPicture& placed, const Title& title, bool within, double brightness,
                     OnTable& on_table) const;

    std::vector<glm::dvec2> room_; ///< what the projector's picture covers of the table
    Pinhole projector_;
    RigidTransform table_from_projector_;
    double text_brightness_ = 0.6; ///< share of the projector's light
    std::vector<Card> cards_;
    TextureId square_ = TextureId::None;
    TextureId more_ = TextureId::None;
    TextureId band_ = TextureId::None; ///< bright along its middle, with soft sides
    std::uint64_t planned_gpu_bytes_ = 0;
    std::vector<std::string> notes_;
};

} // namespace frustumscreen
