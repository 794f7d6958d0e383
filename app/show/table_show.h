/// The pictures on the table to choose from: the artifacts' small pictures with titles, the place that leads to the
/// next page, and the ring around the prop.
///
/// A pack without a table picture shows an outlined square with its title in it.
///
/// Frames   table T, metres.
/// Threads  `read` on any, without a context; everything else on the render thread, with the display's context
///          current. `place` allocates nothing.
/// Errors   none. A pack whose picture or titles cannot be read is shown as a square, and a note says why.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/render/gpu_store.h"
#include "app/residency/on_table.h"
#include "app/settings/settings.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace frustumscreen::show {

class TableShow {
public:
    struct Request {
        std::vector<std::filesystem::path> packs; ///< in the catalogue's order
        bool all_languages = false;               ///< a button changes the language
    };
    TableShow() = default; ///< shows nothing
    /// Reads the packs; nothing is in the store yet.
    [[nodiscard]] static TableShow read(const settings::Settings& settings, const Request& request);
    /// Uploads about `max_bytes` more, or a little more. Pictures that the driver refuses are not shown.
    void upload(render::GpuStore& store, std::uint64_t max_bytes);
    [[nodiscard]] bool ready() const { return uploaded_ == textures_.size(); }
    /// Releases a part of the store's contents; false: nothing was left. Nothing can be placed afterwards.
    bool release_some(render::GpuStore& store);

    /// `shadow`: the prop's.
    void place(const exhibit::Presentation& presentation,
               const std::optional<typography::TablePolygon>& shadow, residency::OnTable& on_table) const;
    /// The picture that grows into the prop's place. It lies on the prop, and the prop does not hide it.
    void place_placeholder(const exhibit::PresentedPlaceholder& placeholder,
                           residency::OnTable& on_table) const;
    /// Places one picture of each kind, so that drivers compile for them before the first frame.
    void place_samples(const glm::dvec2& at_m, residency::OnTable& on_table) const;

    [[nodiscard]] std::uint64_t planned_gpu_bytes() const { return planned_gpu_bytes_; }
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

private:
    /// A texture in the store, or one to be uploaded, whose picture is kept until then.
    struct Texture {
        std::variant<image::Image<std::uint8_t>, std::vector<image::Image8>>
            picture; ///< coverage; light with mip levels
        scene::TextureId id = scene::TextureId::None;
    };
    static constexpr std::size_t no_texture = ~std::size_t{0};
    struct Picture {
        std::size_t texture = no_texture; ///< index into `textures_`
        glm::dvec2 size{1.0};             ///< in any unit
    };
    struct Title {
        std::size_t texture = no_texture;
        glm::dvec2 size_m{0.0};
    };
    struct Card {
        Picture picture; ///< no texture: the pack has none
        std::vector<std::string> languages;
        std::vector<Title> titles; ///< by language
    };
    struct Loader;
    [[nodiscard]] scene::TextureId id(std::size_t texture) const {
        return texture < textures_.size() ? textures_[texture].id : scene::TextureId::None;
    }

    void place_card(const exhibit::PlacedPicture& placed, const exhibit::Presentation& presentation,
                    residency::OnTable& on_table) const;
    void place_title(const exhibit::PlacedPicture& placed, const Title& title, bool within, double brightness,
                     residency::OnTable& on_table) const;

    std::vector<glm::dvec2> picture_outline_m_; ///< the part of the table that the projector's picture covers
    geometry::Pinhole projector_;
    geometry::RigidTransform table_from_projector_;
    double text_brightness_ = 0.6; ///< fraction of the projector's light
    std::vector<Card> cards_;
    std::vector<Texture> textures_;
    std::size_t uploaded_ = 0; ///< number of `textures_`
    std::size_t released_ = 0; ///< number of `textures_`
    std::size_t square_ = no_texture;
    std::size_t more_ = no_texture;
    std::size_t band_ = no_texture; ///< bright along its middle, with soft sides
    std::uint64_t planned_gpu_bytes_ = 0;
    std::vector<std::string> notes_;
};

} // namespace frustumscreen::show
