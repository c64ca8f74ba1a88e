/* Colours of eight pixels, 0..1, and their pictures: RGBA, red in the lowest byte. */
#ifndef TOUCHSTONE_COLOUR_MATH_H
#define TOUCHSTONE_COLOUR_MATH_H

typedef struct Colour8 {
    float8 r, g, b;
} Colour8;

INLINE Colour8 choose_colour8(const Colour8 otherwise, const Colour8 where_set, const int8 mask) {
    const Colour8 c = {select(otherwise.r, where_set.r, mask), select(otherwise.g, where_set.g, mask),
                       select(otherwise.b, where_set.b, mask)};
    return c;
}

INLINE Colour8 one_colour8(const float4 colour) {
    const Colour8 c = {(float8)(colour.x), (float8)(colour.y), (float8)(colour.z)};
    return c;
}

INLINE Colour8 colour_of8(const uint8 rgba) {
    const float scale = 1.0f / 255.0f;
    const Colour8 c = {convert_float8(rgba & (uint8)(0xff)) * scale, convert_float8((rgba >> (uint8)(8)) & (uint8)(0xff)) * scale,
                       convert_float8((rgba >> (uint8)(16)) & (uint8)(0xff)) * scale};
    return c;
}

INLINE uint8 to_byte8(const float8 value) { return convert_uint8_rte(clamp(value, 0.0f, 1.0f) * 255.0f); }

/* alpha: 0 or 255. */
INLINE uint8 pack_rgba8(const Colour8 colour, const uint8 alpha) {
    return to_byte8(colour.r) | (to_byte8(colour.g) << (uint8)(8)) | (to_byte8(colour.b) << (uint8)(16)) | (alpha << (uint8)(24));
}

#endif
