// Cross-section of a bearing, drawn from its numbers; each dimension can be pointed at.

const SVG = "http://www.w3.org/2000/svg"

function shape(tag, attributes = {}, ...children) {
  const made = document.createElementNS(SVG, tag)
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value)
  made.append(...children)
  return made
}

// `pointed` hears which dimension was clicked. Returns the picture, `draw(numbers)`, `mark(name)`.
function bearing_picture(pointed) {
  const picture = shape("svg", {
    viewBox: "0 0 740 400", role: "img", class: "picture",
    "aria-label": "Cross-section of the bearing with its dimensions",
  })
  let marked = ""

  const symbol = (text, below) => {
    const parts = [shape("tspan", {}, text)]
    if (below) parts.push(shape("tspan", { class: "below", dy: 4 }, below))
    return parts
  }
  const label = (x, y, [text, below, after], anchor = "middle") => {
    const words = shape("text", { x, y, "text-anchor": anchor, class: "label" }, ...symbol(text, below))
    if (after) words.append(shape("tspan", { dy: below ? -4 : 0 }, after))
    return words
  }
  // Everything of one dimension: it lights up together, and a click on it leads to its control.
  const dimension = (name, ...parts) => {
    const group = shape("g", { class: "dimension", "data-name": name }, ...parts)
    group.classList.toggle("marked", name === marked)
    group.addEventListener("click", () => pointed(name))
    return group
  }
  const arrow = (x1, y1, x2, y2, both = true) => {
    const length = Math.hypot(x2 - x1, y2 - y1)
    const line = [shape("path", { d: `M${x1} ${y1}L${x2} ${y2}`, class: "line" }),
      shape("path", { d: `M${x1} ${y1}L${x2} ${y2}`, class: "grip" })]
    const head = (x, y, dx, dy) => shape("path", { class: "head", d:
      `M${x} ${y}l${-7 * dx - 2.6 * dy} ${-7 * dy + 2.6 * dx}l${5.2 * dy} ${-5.2 * dx}z` })
    if (length < 4) return line
    const dx = (x2 - x1) / length, dy = (y2 - y1) / length
    line.push(head(x2, y2, dx, dy))
    if (both) line.push(head(x1, y1, -dx, -dy))
    return line
  }
  const dot = (x, y, cls = "centre") => shape("circle", { cx: x, cy: y, r: 2.6, class: cls })
  const witness = (x1, y1, x2, y2) => shape("path", { d: `M${x1} ${y1}L${x2} ${y2}`, class: "witness" })

  // Half of the section through the shaft, to scale: radii are heights above its middle, all rows
  // beside each other.
  const section = (n) => {
    const rim = Math.max(...n.rows.map((row) => row.outer_raceway_radius + 0.42 * row.ball_diameter))
    const hole = Math.min(...n.rows.map((row) => row.inner_raceway_radius - 0.42 * row.ball_diameter))
    const largest = Math.max(...n.rows.map((row) => row.ball_diameter))
    const places = n.rows.map(({ place }) => place)
    const span = Math.max(...places) - Math.min(...places)
    const scale = Math.min(325 / rim, 84 / largest, 150 / (span + 1.6 * largest))
    const axis = 372, middle = 155
    const up = (radius) => axis - scale * radius
    const ball = 0.5 * scale * n.ball_diameter
    const rollers = n.picture.element === "roller", sphere = n.picture.outer === "sphere"
    const long = rollers ? 0.5 * scale * n.roller_length : ball
    const centre = up(0.5 * n.pitch_diameter)
    const half = 0.5 * scale * (span + (rollers ? n.roller_length + 0.6 * largest : 1.6 * largest))
    const left = middle - half, right = middle + half
    // rows from the right to the left
    const at = n.rows.map((row, number) => ({ number, x: middle + scale * row.place,
      ball: 0.5 * scale * row.ball_diameter, centre: up(0.5 * row.pitch_diameter),
      outer: up(row.outer_raceway_radius), inner: up(row.inner_raceway_radius) })).sort((a, b) => b.x - a.x)
    const top = up(rim), bore = Math.min(up(Math.max(hole, 0)), axis - 6)
    const outer = up(n.outer_raceway_radius), inner = up(n.inner_raceway_radius)
    const groove = (row, level, side) => {
      const edge = level + side * 0.42 * row.ball, wide = 0.8 * row.ball
      return `V${edge}` + (rollers ? `H${row.x + long + 1}V${level}H${row.x - long - 1}V${edge}`
        : `H${row.x + wide}Q${row.x} ${level - side * 0.42 * row.ball} ${row.x - wide} ${edge}`)
    }
    const arc = () => {  // the sphere, about the middle of the shaft
      const radius = scale * n.outer_raceway_radius
      const edge = axis - Math.sqrt(Math.max(radius * radius - half * half, 0))
      return `V${edge}A${radius} ${radius} 0 0 0 ${left} ${edge}`
    }
    const flat = `V${inner}H${left}`  // rollers run on an inner ring without shoulders
    const line = ({ number, x, ball, centre }) => {  // of contact, on to the middle of the shaft
      const row = n.rows[number], lean = row.facing * Math.tan(row.contact_angle), over = 1.5 * ball
      return shape("path", { class: "line dashed",
        d: `M${x + over * lean} ${centre - over}L${x - (axis - centre) * lean} ${axis}` })
    }
    const paired = n.rows.length > 1 && !sphere && n.rows.some((row) => row.contact_angle > 0)
    const parts = [
      shape("path", { class: "steel", d: `M${left} ${top}H${right}` + (sphere ? arc()
        : at.map((row) => groove(row, row.outer, 1)).join("") + `H${left}`) + "Z" }),
      shape("path", { class: "steel", d: `M${left} ${bore}H${right}` + (rollers ? flat
        : at.map((row) => groove(row, row.inner, -1)).join("") + `H${left}`) + "Z" }),
      ...at.map(({ x, ball, centre }) => rollers
        ? shape("rect", { class: "ball", x: x - long, y: centre - ball, width: 2 * long, height: 2 * ball, rx: 2 })
        : shape("circle", { class: "ball", cx: x, cy: centre, r: ball })),
      ...(paired ? at.map(line) : []),
      shape("path", { class: "axis", d: `M14 ${axis}H296` }),
    ]
    const height = (name, x, from, level, text) => dimension(name,
      witness(from, level, x - 5 * Math.sign(from - x), level), ...arrow(x, axis, x, level),
      label(x + (x < middle ? -5 : 5), axis - 0.45 * (axis - level), text, x < middle ? "end" : "start"))
    // of rows that are not alike the second has names of its own
    const second = at.find(({ number }) => number === 1)
    const unlike = second && (n.second_ball_diameter !== null || n.second_pitch_diameter !== null)
    const { x: first } = unlike ? at.find(({ number }) => number === 0) : at[0]
    if (rollers)
      parts.push(dimension("roller_length_mm", ...arrow(first - long, centre + 0.45 * ball, first + long, centre + 0.45 * ball),
        label(first, centre + 0.45 * ball - 4, ["l"])))
    if (n.rows.length > 1) {
      const under = up(0) + 14
      parts.push(dimension("row_distance_mm", witness(at[1].x, at[1].centre, at[1].x, under - 6),
        witness(at[0].x, at[0].centre, at[0].x, under - 6), ...arrow(at[1].x, under - 8, at[0].x, under - 8),
        label(middle, under - 12, ["a"])))
    }
    if (unlike) {
      const { x, ball, centre } = second
      parts.push(dimension("second_ball_diameter_mm", ...arrow(x - ball, centre, x + ball, centre),
        label(x, centre - 5, ["D", "b2"])),
        dimension("second_pitch_diameter_mm", ...arrow(x - 0.6 * ball, axis, x - 0.6 * ball, centre),
          label(x - 0.6 * ball - 5, axis - 0.3 * (axis - centre), ["D", "p2", "/2"], "end")))
    }
    return [...parts,
      ...(rollers || sphere ? [] : [height("groove_center_radius_mm", 26, left, up(n.groove_center_radius), ["r", "d"])]),
      height("pitch_diameter_mm", Math.min(72, left - 6), left, centre, ["D", "p", "/2"]),
      height("inner_raceway_radius_mm", Math.max(236, right + 8), right, inner, ["R", "i"]),
      height("outer_raceway_radius_mm", Math.max(266, right + 38), right, outer, ["R", "o"]),
      dimension("ball_diameter_mm", ...(rollers ? arrow(first + 0.6 * long, centre - ball, first + 0.6 * long, centre + ball)
        : arrow(first - ball, centre, first + ball, centre)),
        rollers ? label(first + 0.6 * long - 5, centre + 3, ["D", "b"], "end") : label(first, centre - 5, ["D", "b"])),
      ...at.map(({ x, centre }) => dot(x, centre)),
      label(155, 396, ["to scale, above the middle of the shaft"]),
    ]
  }

  // A ball between its grooves; what is small in a bearing is drawn large.
  const contact = (n) => n.picture.element === "roller" ? line_contact(n) : grooves(n)
  // A roller lies on its races along its length.
  const line_contact = (n) => {
    const x = 440, y = 142, high = 60
    const long = Math.min(110, Math.max(25, high * n.roller_length / n.ball_diameter))
    const gap = n.radial_clearance > 0 ? 5 + 16 * (1 - Math.exp(-n.radial_clearance / 2e-5)) : 0
    const race = (level, depth) => shape("rect", { class: "steel", x: x - 124, y: Math.min(level, level + depth),
      width: 248, height: Math.abs(depth) })
    const right = x + long + 20, low = y + high
    return [race(y - high, -30), race(low + gap, 30),
      shape("rect", { class: "ball", x: x - long, y: y - high, width: 2 * long, height: 2 * high, rx: 5 }),
      ...(gap ? [dimension("radial_clearance_um",
        ...arrow(right, low - 18, right, low, false), ...arrow(right, low + gap + 18, right, low + gap, false),
        label(right + 8, low + 4 + 0.5 * gap, ["r", "L"], "start"))] : []),
      label(x + 30, 270, ["a roller on its races, clearance drawn large"]),
      label(x + 30, 288, ["no tilt, and nothing along the shaft"])]
  }
  const grooves = (n) => {
    const x = 440, y = 142, ball = 76
    const drawn = (radius) => ball * (0.16 + 2.4 * Math.min(Math.max(2 * radius / n.ball_diameter - 1, 0), 0.2))
    const known = n.outer_groove_radius !== null
    const sphere = n.picture.outer === "sphere"
    const likely = 0.5 * (n.groove_center_distance + n.ball_diameter)
    const far = [n.outer_groove_radius ?? (sphere ? n.outer_raceway_radius : likely),
      n.inner_groove_radius ?? likely].map(drawn)
    const gap = n.radial_clearance > 0 ? 5 + 16 * (1 - Math.exp(-n.radial_clearance / 2e-5)) : 0
    const sin = Math.sin(n.contact_angle), cos = Math.cos(n.contact_angle)
    const outer = { x: x - far[0] * sin, y: y + far[0] * cos, r: ball + far[0] }
    const inner = { x: x + far[1] * sin, y: y - far[1] * cos + gap, r: ball + far[1] }
    const at = (circle, angle) =>
      [circle.x + circle.r * Math.sin(angle), circle.y - circle.r * Math.cos(angle)]
    const ring = (circle, side) => {
      const spread = 0.9
      const [a, b] = [-spread, spread].map((turn) => at(circle, side > 0 ? turn : Math.PI - turn))
      const back = y - side * (ball + 34) + (side < 0 ? gap : 0)
      return shape("path", { class: "steel", d: `M${x - 118} ${back}V${a[1]}H${a[0]}A${circle.r} ${circle.r} ` +
        `0 0 ${side > 0 ? 1 : 0} ${b[0]} ${b[1]}H${x + 118}V${back}Z` })
    }
    const top = [x + ball * sin, y - ball * cos], foot = [x - ball * sin, y + ball * cos]
    const parts = [
      ring(outer, 1), ring(inner, -1),
      shape("circle", { class: "ball", cx: x, cy: y, r: ball }),
      dimension("contact_angle_deg",
        shape("path", { class: "line dashed", d: `M${foot}L${x + 1.5 * ball * sin} ${y - 1.5 * ball * cos}` }),
        shape("path", { class: "witness", d: `M${x} ${y}V${y - 1.5 * ball}` }),
        shape("path", { class: "line", fill: "none", d: n.contact_angle > 0
          ? `M${x} ${y - 1.32 * ball}A${1.32 * ball} ${1.32 * ball} 0 0 1 ` +
            `${x + 1.32 * ball * sin} ${y - 1.32 * ball * cos}` : "" }),
        label(x + 1.32 * ball * Math.sin(0.5 * n.contact_angle) + 4, y - 1.32 * ball * Math.cos(0.5 * n.contact_angle) - 5,
          ["α", "0"], "start")),
      ...(sphere ? [] : [dimension("groove_center_distance_um", ...arrow(outer.x, outer.y, inner.x, inner.y),
        dot(outer.x, outer.y), dot(inner.x, inner.y),
        label(0.5 * (outer.x + inner.x) - 9, 0.5 * (outer.y + inner.y) + 4, ["A", "0"], "end"))]),
    ]
    if (known) {
      const a = at(outer, -0.62), b = at(inner, Math.PI + 0.62)
      parts.push(
        dimension("outer_groove_radius_mm", ...arrow(outer.x, outer.y, a[0], a[1], false),
          label(a[0] - 4, a[1] - 6, ["r", "o"], "end")),
        dimension("inner_groove_radius_mm", ...arrow(inner.x, inner.y, b[0], b[1], false),
          label(b[0] - 4, b[1] + 14, ["r", "i"], "end")))
    }
    if (gap) {
      const right = x + ball + 52, low = y + ball
      parts.push(dimension("radial_clearance_um",
        witness(x - 10, low, right + 6, low), witness(x + 10, low + gap, right + 6, low + gap),
        ...arrow(right, low - 18, right, low, false), ...arrow(right, low + gap + 18, right, low + gap, false),
        label(right + 8, low + 4 + 0.5 * gap, ["r", "L"], "start")))
    }
    return [...parts, label(x, 300, ["a ball in its grooves, gaps drawn large"])]
  }

  // All balls, seen along the shaft.
  const front = (n) => {
    const x = 660, y = 100, scale = 66 / (n.outer_raceway_radius + 0.3 * n.ball_diameter)
    const pitch = 0.5 * scale * n.pitch_diameter
    const balls = Array.from({ length: n.n_balls }, (_, i) => {
      const turn = 2 * Math.PI * i / n.n_balls
      return shape("circle", { class: "ball", cx: x + pitch * Math.cos(turn), cy: y - pitch * Math.sin(turn),
        r: 0.5 * scale * n.ball_diameter })
    })
    const circle = (radius) => shape("circle", { class: "ring", cx: x, cy: y, r: scale * radius })
    return [circle(n.outer_raceway_radius), circle(n.inner_raceway_radius),
      dimension("n_balls", ...balls, label(x, y + 5, ["N", "b",
        ` = ${n.second_n_balls !== null ? n.rows.map((row) => row.n_balls).join(" + ")
          : `${n.rows.length > 1 ? `${n.rows.length} · ` : ""}${n.n_balls}`}`]))]
  }

  // What a ball carries when it is pressed: the curve that K stands for.
  const law = (n) => {
    const x = 606, y = 300, width = 104, height = 74
    const most = 20e-6, greatest = 1.6e10
    const top = Math.min(1, Math.sqrt(n.load_deflection_factor / greatest))
    const points = Array.from({ length: 25 }, (_, i) =>
      `${x + width * i / 24} ${y - height * top * (i / 24) ** n.exponent}`)
    return [
      shape("path", { class: "ring", d: `M${x} ${y - height - 8}V${y}H${x + width + 8}` }),
      dimension("load_deflection_factor",
        shape("path", { class: "line curve", d: "M" + points.join("L") }),
        shape("path", { class: "grip", d: "M" + points.join("L") }),
        label(x + 8, y - height + 4, ["Q = K δ", "", n.exponent_text], "start")),
      label(x + width, y + 16, [`compression δ, to ${1e6 * most} µm`], "end"),
    ]
  }

  return {
    picture,
    draw: (numbers) => picture.replaceChildren(
      ...section(numbers), ...contact(numbers), ...front(numbers), ...law(numbers)),
    mark: (name) => {
      marked = { youngs_modulus_gpa: "load_deflection_factor", poisson: "load_deflection_factor" }[name] ?? name
      for (const group of picture.querySelectorAll(".dimension"))
        group.classList.toggle("marked", group.dataset.name === marked)
    },
  }
}
