// What stands under the pointer on a heat map: `wanted` is "x", "y" or "value". `say` is put in
// front of this file: it makes words of the number in a `cell`; `rounded` of the house
// style writes them.
const at = place_on(image, stands, count, special_vars.x, special_vars.y)
if (!at) return ""
const words_of = (side) => {
  const {words, unit} = sides[side.which]
  return digits === null ? `${words}: ${rounded(side.middle, 4)}${unit}`
    : `${words} ${Math.max(0, side.value).toFixed(digits)}${unit}`
}
if (wanted == "x") return words_of(at.x)
if (wanted == "y") return words_of(at.y)
return say(image.data.image[at.map][at.row*at.columns + at.column], at)
