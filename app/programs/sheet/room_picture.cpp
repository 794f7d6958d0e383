#include "app/programs/sheet/room_picture.h"

#include "app/programs/sheet/sheet_cameras.h"
#include "app/simulation/room.h"
#include "app/typography/canvas.h"

#include <array>

namespace frustumscreen::programs {

namespace {

constexpr typography::Colour background{14, 15, 18};
constexpr typography::Colour words{190, 194, 200};
constexpr typography::Colour beam{150, 190, 230};
constexpr double beam_opacity = 0.16;
constexpr typography::Colour outline_colour{66, 96, 100};

constexpr int gap = 10;
constexpr int label_height = 34;
constexpr double label_px = 17.0;
constexpr glm::ivec2 room_tile{760, 880};
constexpr int right_width = 600;
constexpr glm::ivec2 visitor_tile{right_width, 471};

/// Draws the edges of the light between the lens and the picture on the table.
void draw_beam(typography::Canvas& canvas, const simulation::VisitorScene& scene,
               const simulation::VisitorCamera& camera) {
    const geometry::RigidTransform camera_from_table = camera.table_from_camera.inverse();
    const auto from = camera.pinhole.pixel(camera_from_table.point(scene.table_from_projector.translation));
    for (const glm::dvec3& corner : lit_corners(scene)) {
        if (const auto to = camera.pinhole.pixel(camera_from_table.point(corner)); from && to) {
            canvas.line(*from, *to, 2.0, beam, beam_opacity);
        }
    }
}

image::Image8 projector_view(const simulation::VisitorScene& scene, const image::Image8& picture,
                             const glm::ivec2& size) {
    typography::Canvas canvas(size.x, size.y, typography::Colour(0));
    canvas.picture(picture, {0, 0}, {picture.width, picture.height}, {0, 0}, size);
    for (FaceOutline outline : face_outlines(scene)) {
        for (glm::dvec2& point : outline) {
            point *= glm::dvec2(size) / glm::dvec2(picture.width, picture.height);
        }
        canvas.outline(outline, 1.0, outline_colour, 0.55);
    }
    return canvas.take();
}

void place(typography::Canvas& canvas, const image::Image8& image, const glm::ivec2& corner,
           const char* label, const typography::Typesetter& typesetter) {
    const glm::ivec2 size(image.width, image.height);
    canvas.picture(image, {0, 0}, glm::dvec2(size), corner, size);
    canvas.text(typesetter, label, {corner.x + 2.0, corner.y + size.y + 7.0}, label_px, words);
}

} // namespace

Result<image::Image8> room_picture(const settings::Settings& settings, const SheetFrame& frame,
                                   const typography::Typesetter& typesetter) {
    TRY(const image::Image8 picture, read_picture(frame, settings.projector.pinhole));
    const simulation::VisitorScene scene =
        visitor_scene(settings, frame.tracked_state, picture.width, picture.height);
    simulation::VisitorScene in_room = scene;
    const simulation::VisitorCamera bystander = room_camera(scene, room_tile);
    in_room.eye_m = bystander.table_from_camera.translation;
    in_room.objects = simulation::room_around(scene.table_size_m, scene.table_from_projector.translation);
    typography::Canvas room(simulation::visitor_view(in_room, picture, bystander));
    draw_beam(room, scene, bystander);

    const glm::ivec2 projector_tile(right_width, right_width * picture.height / picture.width);
    const int right = 2 * gap + room_tile.x;
    const int below = gap + projector_tile.y + label_height;
    typography::Canvas canvas(right + right_width + gap,
                              gap + std::max(room_tile.y, projector_tile.y + label_height + visitor_tile.y) +
                                  label_height,
                              background);
    place(canvas, room.image(), {gap, gap}, "The table in its room, seen over the visitor\u2019s shoulder",
          typesetter);
    place(canvas, projector_view(scene, picture, projector_tile), {right, gap},
          "The projector\u2019s picture", typesetter);
    simulation::VisitorScene seen = scene;
    seen.objects = in_room.objects;
    place(canvas, simulation::visitor_view(seen, picture, framed_camera(scene, visitor_tile)), {right, below},
          "What the visitor sees", typesetter);
    return canvas.take();
}

} // namespace frustumscreen::programs
