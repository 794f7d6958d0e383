#include "app/show/eye_letters.h"

namespace frustumscreen::show {

namespace {

constexpr typography::Colour grey{190, 190, 190}; ///< the pattern's lines are seen on it
constexpr std::array<typography::Colour, 2> anaglyph{{{255, 0, 0}, {0, 255, 255}}};

render::PictureUpload upload_for(const typography::EyeLetter& letter) {
    return {letter.square.width, letter.square.height};
}

} // namespace

EyeLetters::EyeLetters(const EyeParts& eyes, const image::Image8& pattern,
                       const typography::Typesetter& typesetter)
    : eyes_(eyes), letters_(typography::eye_letters(pattern, typesetter)), uploads_{upload_for(letters_[0]),
                                                                                    upload_for(letters_[1])} {
}

void EyeLetters::put(const image::Image8& picture) {
    for (std::size_t eye = 0; eye < letters_.size(); ++eye) {
        const typography::Colour colour = eyes_.are_apart() ? grey : anaglyph.at(eye);
        uploads_.at(eye).put(typography::with_letter(picture, letters_.at(eye), colour));
    }
}

void EyeLetters::show(unsigned framebuffer) {
    for (std::size_t eye = 0; eye < letters_.size(); ++eye) {
        const PixelRectangle& square = letters_.at(eye).square;
        eyes_.show_to(eye, uploads_.at(eye), framebuffer, {square.x, square.y});
    }
}

} // namespace frustumscreen::show
