// What BokehJS does anew at each repaint of a figure, and need not. Its private names of
// BokehJS stand here; those of Bokeh in serve/bokeh_internals.py.
//
// A slider that is dragged repaints up to ten figures thirty times a second, each with a few lines
// of some hundred points. Most of that time goes into what is the same each time or is never seen:
// see each part. Private names may go with any release: a part whose names are not there is left
// out, BokehJS then does as it always did, and `window.fast_figures.missing` says which. Tests and
// benchmarks leave out the parts that they name in `window.fast_figures.without` before.
{
  const missing = []
  const without = globalThis.fast_figures?.without ?? []
  const view_of = (name) => globalThis.Bokeh?.Models?.get(name)?.prototype.default_view?.prototype
  const owner = (proto, name) => {
    while (proto && !Object.hasOwn(proto, name)) proto = Object.getPrototypeOf(proto)
    return proto
  }
  const method = (proto, name) => owner(proto, name)?.[name]
  const getter = (proto, name) => {
    const place = owner(proto, name)
    return place && Object.getOwnPropertyDescriptor(place, name).get
  }
  const redefine = (proto, name, get) => Object.defineProperty(owner(proto, name), name, { configurable: true, get })
  const part = (name, needed, change) => {
    if (without.includes(name) || without.includes("all")) return
    if (needed.every((one) => typeof one === "function")) change()
    else missing.push(name)
  }
  const nothing = () => {}
  const module = (place, name) => {
    try { return globalThis.Bokeh.require(place)[name]?.prototype } catch { /* moved */ }
  }

  const renderer = view_of("GlyphRenderer")
  const line = view_of("Line")
  const axis = view_of("LinearAxis")
  const figure = view_of("Plot")

  // Lines, dots and grids have an element each, empty, with six style sheets, one of which puts it
  // where they are: styles and layout of the page are worked out anew each time they move.
  const placed = method(renderer, "update_position")
  const styled = method(renderer, "_update_stylesheets")
  part("places of glyphs", [placed, styled], () => {
    for (const view of [renderer, view_of("Grid")]) {
      view._update_stylesheets = function () { this.el.style.display = "none" }
      view.update_position = nothing
    }
  })

  // Each line is held four more times: as it looks selected, not selected, muted, and with fewer
  // points. They get their numbers when they are to be seen.
  const set_data = method(renderer, "set_data")
  const connect_signals = method(renderer, "connect_signals")
  part("hidden glyphs", [set_data, connect_signals], () => {
    const steps = ["set_data", "set_visuals", "after_visuals", "after_lazy_visuals", "map_data"]
    const seen = (view) => {
      const source = view.model.data_source
      const chosen = !(source.selected?.is_empty() ?? false)
      const most = view.plot_model?.lod_threshold
      const many = most != null && (source.get_length() ?? Infinity) > most
      return {
        decimated_glyph: many, muted_glyph: view.model.muted,
        selection_glyph: chosen, nonselection_glyph: chosen || many,
      }
    }
    renderer.set_data = function (...rest) {
      for (const [name, shown] of Object.entries(seen(this))) {
        const glyph = this[name]
        if (!glyph || glyph === this.glyph) continue
        for (const step of steps) {
          if (shown) delete glyph[step]
          else if (typeof glyph[step] === "function") glyph[step] = nothing
        }
      }
      return set_data.apply(this, rest)
    }
    renderer.connect_signals = function () {
      const wake = () => { void this.set_data() }
      this.connect(this.model.data_source.selected.change, wake)
      this.connect(this.model.properties.muted.change, wake)
      connect_signals.call(this)
    }
  })

  // Colours, widths and fonts are worked out with each change of the numbers, though only those that a
  // column holds change with them.
  const set_visuals = method(line, "set_visuals")
  part("looks that stay", [set_visuals, method(line, "_iter_visuals")], () => {
    const counts = new WeakMap()
    owner(line, "set_visuals").set_visuals = function (source, indices) {
      if (counts.get(this) === indices.count) return
      set_visuals.call(this, source, indices)
      if ([...this._iter_visuals()].some((look) => look.get_value().value === undefined)) return
      if (!counts.has(this)) this.connect(this.model.change, () => counts.set(this, null))
      counts.set(this, indices.count)
    }
  })

  // All numbers of a column are copied one by one, to leave out those that are not shown.
  const bits = module("core/util/bitset", "BitSet")
  const select = method(bits, "select")
  part("columns that are shown whole", [select], () => {
    bits.select = function (column) {
      return this.count === column.length ? column : select.call(this, column)
    }
  })

  // Words in a figure follow the numbers, and then ask for all that the numbers have asked for.
  const update_data = method(renderer, "update_data")
  part("one update for all that asks for it", [update_data], () => {
    const coming = new WeakMap()
    renderer.update_data = function (indices) {
      if (indices != null) return update_data.call(this, indices)
      if (!coming.has(this)) {
        coming.set(this, Promise.resolve().then(() => {
          coming.delete(this)
          return update_data.call(this)
        }))
      }
      return coming.get(this)
    }
  })

  // While a hand moves something, what the curves were before stays faintly beneath them, on the axes of
  // now. Numbers are replaced as a whole, so that the old ones need not be copied. Curves in cells, whose
  // axes are numbers of a source that their tag names, are scaled anew.
  const paint_glyph = method(renderer, "_paint")
  part("curves of before", [paint_glyph], () => {
    const FAINT = 0.5
    const before = new Map()  // of each line: its numbers, its points and those of its cells
    // Points a pixel apart: a curve in a cell has three in each.
    const spaced = ({ length }, { sx = [], sy = [] }) => {
      const kept = []
      for (let i = 0, last = -1; i < length; i++) {
        const is_near = Math.abs(sx[i] - sx[last]) + Math.abs(sy[i] - sy[last]) < 1
        if (!is_near) kept.push(last = i)
      }
      return kept
    }
    addEventListener("explorer-hand", ({ detail: held }) => {
      for (const view of before.keys()) view.request_paint()
      before.clear()
      const { index, documents: [page] } = globalThis.Bokeh
      for (const view of held ? index.query(({ glyph }) => glyph?.model.type === "Line") : []) {
        const { data_source: { data }, tags: [name], glyph: { x, y } } = view.model
        const cells = name ? page.get_model_by_name(name) : null  // looks through the whole page
        const kept = spaced(data[x.field], view.glyph)
        const [xs, ys] = [x, y].map(({ field }) => kept.map((i) => data[field][i]))
        const { left, right, bottom, top } = cells?.data ?? {}
        const is_in = (x, y, k) => x >= left[k] && x <= right[k] && y >= bottom[k] - 1e-4 && y <= top[k] + 1e-4
        const places = cells && ys.map((y, i) => left.findIndex((_, k) => is_in(xs[i], y, k)))
        before.set(view, { data, kept, xs, ys, cells, places, was: cells?.data })
      }
    })
    const rescaled = ({ ys, was, places }, { left, bottom, top, low, high }) => {
      if (was.left.length !== left.length) return []
      const by = low.map((least, k) => (was.high[k] - was.low[k]) / (high[k] - least))
      const up = low.map((least, k) => bottom[k] + (was.low[k] - least) / (high[k] - least) * (top[k] - bottom[k]))
      return ys.map((y, i) => {
        const k = places[i], height = up[k] + by[k] * (y - bottom[k])
        return height >= bottom[k] && height <= top[k] ? height : NaN
      })
    }
    // As thin as a pixel, which a browser paints ten times as fast as a line of two.
    const stroke = (ctx, xs, ys) => {
      let drawn = false
      ctx.lineWidth = 1
      ctx.beginPath()
      for (let i = 0; i < xs.length; i++) {
        const is_seen = isFinite(xs[i] + ys[i])
        if (is_seen) drawn ? ctx.lineTo(xs[i], ys[i]) : ctx.moveTo(xs[i], ys[i])
        drawn = is_seen
      }
      ctx.stroke()
    }
    renderer._paint = function (ctx) {
      const { data } = this.model.data_source, old = before.get(this)
      if (old && old.data !== data) {
        const { cells, kept, xs, was } = old, now = data[this.glyph.model.y.field]
        const ys = cells && cells.data !== was ? rescaled(old, cells.data) : old.ys
        const differs = (y, i) => Math.abs(y - now[kept[i]]) > 1e-3 || isNaN(y) !== isNaN(now[kept[i]])
        if (!cells || ys.some(differs)) {
          ctx.save()
          ctx.globalAlpha = FAINT
          this.glyph.visuals.line.set_value(ctx)
          stroke(ctx, this.xscale.v_compute(xs), this.yscale.v_compute(ys))
          ctx.restore()
        }
      }
      paint_glyph.call(this, ctx)
    }
  })

  // Where which point is, for a mouse that hits it: found out when that is asked.
  const index_data = method(line, "index_data")
  const index = getter(line, "index")
  part("index of points", [index_data, index], () => {
    const place = owner(line, "index_data")
    const waits = new WeakSet()
    place.index_data = function () {
      waits.add(this)
    }
    redefine(line, "index", function () {
      if (waits.delete(this)) index_data.call(this)
      return index.call(this)
    })
  })

  // ... and for ranges that follow the lines, which none here does: all are set.
  const followed = getter(figure, "auto_ranged_renderers")
  part("bounds of lines", [followed], () => {
    redefine(figure, "auto_ranged_renderers", function () {
      const all = followed.call(this)
      const ranges = [...this.frame.x_ranges.values(), ...this.frame.y_ranges.values()]
      const set = ranges.every(({ type }) => type === "Range1d")
      return set && all.every(({ model }) => model.coordinates === null) ? [] : all
    })
  })

  // ... and to leave out what lies outside of a frame, which is clipped: a few dots may be painted.
  const mask = method(line, "mask_data")
  part("dots outside of a frame", [mask], () => {
    const FEW = 200
    owner(line, "mask_data").mask_data = function () {
      if (this.data_size > FEW) delete this._mask_data  // the class has it still
      else this._mask_data = null
      return mask.call(this)
    }
  })

  // An axis works out its ticks and their words six times a repaint; they follow from its ranges.
  const ticks = getter(axis, "tick_coords")
  const extents = getter(axis, "extents")
  const labels = method(axis, "compute_labels")
  part("ticks of axes", [ticks, extents, labels], () => {
    const kept = new WeakMap()
    const ends = (range) => [range.start, range.end]
    const key_of = (view) => {
      const known = Object.values(view.model.formatter.args ?? {})
      const shown = known.filter((one) => typeof one?.start === "number").flatMap(ends)
      return [...view.ranges.flatMap(ends), view.loc, ...shown]
    }
    const known = (view) => {
      const key = key_of(view).join()
      let found = kept.get(view)
      if (found === undefined) {
        const { model } = view
        const forget = () => { kept.set(view, {}) }
        view.connect(model.change, forget)
        view.connect(model.ticker.change, forget)
        view.connect(model.formatter.change, forget)
      }
      if (found?.key !== key) kept.set(view, found = { key, labels: new Map() })
      return found
    }
    const numeric = (view) => view.ranges.every((range) => typeof range.start === "number")
    const keep = (name, compute) => redefine(axis, name, function () {
      return numeric(this) ? known(this)[name] ??= compute.call(this) : compute.call(this)
    })
    keep("tick_coords", ticks)
    keep("extents", extents)
    owner(axis, "compute_labels").compute_labels = function (ticks) {
      if (!numeric(this) || this._major_label_views?.size) return labels.call(this, ticks)
      const { labels: found } = known(this)
      const name = ticks.join()
      if (!found.has(name)) found.set(name, labels.call(this, ticks))
      return found.get(name)
    }
  })

  // The size of letters in "em", which no figure here has: asking for it works out all styles. It is
  // asked for once.
  const size = getter(figure, "base_font_size")
  part("size of letters", [size], () => {
    let found = null
    redefine(figure, "base_font_size", function () { return found ??= size.call(this) })
  })

  // A tab may be many screens long: a figure that is not nearly in sight is painted once all others
  // rest, one at a time. Whether its axes have room is looked at when it is shown.
  let paint_together = (act) => act(), comes_back = false
  const build_layout = method(figure, "_update_layout")
  const paint = method(figure, "paint")
  const save = method(figure, "export")
  const relayout = method(figure, "_invalidate_layout_if_needed")
  part("figures out of sight", [build_layout, paint, save, relayout], () => {
    const NEAR = 0.7, REST = 700  // of the window, above and below it; ms
    const AT_ONCE = 3  // figures of a tab that opens; the watch has the others painted in a frame of their own
    const views = new WeakMap(), near = new WeakMap(), unpainted = new Set()
    const missed = new WeakSet()  // to be painted while their tab was closed
    const paint_now = (view) => {
      unpainted.delete(view)
      return paint.call(view)
    }
    // A browser may have no idle time for minutes: then it is painted all the same.
    const idle = window.requestIdleCallback
      ? (act) => requestIdleCallback(act, { timeout: REST })
      : (act) => setTimeout(act, 50)
    let rest
    const paint_one = () => {
      const [view] = unpainted
      if (view === undefined) return
      if (view.is_displayed) paint_now(view)
      else missed.add(view)
      unpainted.delete(view)
      idle(paint_one)
    }
    const paint_later = (view) => {
      unpainted.add(view)
      clearTimeout(rest)
      rest = setTimeout(() => idle(paint_one), REST)
      view._is_displayed = false
      try { paint.call(view) } finally { view._is_displayed = true }
    }
    const watch = new IntersectionObserver((entries) => {
      for (const { target, isIntersecting } of entries) {
        const view = views.get(target)
        near.set(view, isIntersecting)
        if (isIntersecting && unpainted.has(view)) view.request_repaint()
      }
    }, { rootMargin: `${100 * NEAR}%`, scrollMargin: `${100 * NEAR}%` })
    const is_near = (view) => {
      if (!views.has(view.el)) {
        views.set(view.el, view)
        watch.observe(view.el)
        const { top, bottom } = view.el.getBoundingClientRect()
        near.set(view, bottom > -NEAR * innerHeight && top < (1 + NEAR) * innerHeight)
      }
      return near.get(view)
    }
    // Figures that are laid out together are painted when all of them are: else each would be asked
    // where it is after another one has changed a style.
    let together = null
    figure.paint = function () {
      missed[this.is_displayed ? "delete" : "add"](this)
      if (together) together.add(this)
      else if (this.is_displayed && !is_near(this)) paint_later(this)
      else paint_now(this)
    }
    paint_together = (act) => {
      if (together) return act()
      const figures = together = new Set()
      try {
        act()
      } finally {
        together = null
        const fresh = [...figures].filter((one) => one.is_displayed && !views.has(one.el) && is_near(one))
        for (const one of fresh.slice(AT_ONCE)) near.set(one, false)
        written_once(() => { for (const one of figures) one.paint() })
      }
    }
    figure.export = function (...rest) {
      if (unpainted.has(this)) paint_now(this)
      return save.apply(this, rest)
    }
    figure._invalidate_layout_if_needed = function () {
      if (this.is_displayed) relayout.call(this)
    }
    // In a tab that comes back a figure as large as it was has the right pixels.
    figure._update_layout = function () {
      const before = { _needs_paint: this._needs_paint, _invalidate_all: this._invalidate_all }
      build_layout.call(this)
      if (comes_back && !missed.has(this)) Object.assign(this, before)
    }
  })

  // A toolbar is hidden until the mouse is over its figure: its buttons, each with six style sheets,
  // come then.
  const toolbar = view_of("Toolbar")
  const add_buttons = method(toolbar, "_build_tool_button_views")
  const arrange = method(toolbar, "_after_render")
  const turn = method(toolbar, "_on_visible_change")
  part("hidden toolbars", [add_buttons, arrange, turn, getter(toolbar, "visible")], () => {
    const bare = new WeakSet()
    toolbar._build_tool_button_views = async function () {
      if (this.visible) return add_buttons.call(this)
      bare.add(this)
      this._tool_buttons = []
    }
    toolbar._after_render = function () {
      if (!bare.has(this)) arrange.call(this)
    }
    toolbar._on_visible_change = function () {
      turn.call(this)
      if (this.visible && bare.delete(this)) add_buttons.call(this).then(() => this.rerender())
    }
  })

  // The script of each part of the page is compiled for itself, and asks for the view of its model:
  // all views are looked through, most of them glyphs.
  const scripted = globalThis.Bokeh?.Models?.get("panel.models.esm.ReactiveESM")?.prototype
  const compile = method(scripted, "compile")
  const index_of_views = module("core/view_manager", "ViewManager")
  const find = method(index_of_views, "find_one_by_id")
  part("scripts of parts", [compile, find], () => {
    const known = new Map()
    scripted.compile = function () {
      if (this.bundle != null) return compile.call(this)
      const key = `${this.type} ${this.esm}`
      if (!known.has(key)) known.set(key, compile.call(this))
      return known.get(key)
    }
    const among = (views, id) => {
      for (const view of views) {
        const found = view.model.id === id ? view : among(view.child_views ?? [], id)
        if (found) return found
      }
      return null
    }
    index_of_views.find_one_by_id = function (id) { return among(this, id) ?? find.call(this, id) }
  })

  // The layer above a canvas that hears the mouse is a stop of Tab without a name. No key does anything
  // there: whoever goes by keys passes it.
  const canvas = view_of("Canvas")
  const begin = method(canvas, "initialize")
  part("stops of Tab", [begin], () => {
    canvas.initialize = function () {
      begin.call(this)
      if (this.events_el) this.events_el.tabIndex = -1
    }
  })

  // The hint that Ctrl and the wheel zoom is white on white on a dark page.
  const notify = method(figure, "notify_about")
  part("colours of hints", [notify], () => {
    figure.notify_about = function (message) {
      notify.call(this, message)
      for (const hint of this._notifications?.elements ?? [])
        hint.style = { color: "var(--ink)", "background-color": "var(--card)" }
    }
  })

  // Colours and widths of an axis, a grid or a title may come from style sheets, and are asked for
  // there, one by one, each time. No style sheet here says any.
  const visual = module("core/visuals/visual", "VisualProperties")
  part("looks out of style sheets", [method(visual, "_get_css_value")], () => {
    visual._get_css_value = () => ""
  })

  // All style sheets of what is laid out are emptied and written anew, mostly as they were, and in
  // between it is asked how large something is: the browser works out all styles each time. Here
  // they are written when all of them are known, and those that stay are not touched.
  // Half of them stay empty: what is in the document is looked through whenever a sheet changes, so
  // an empty one has a comment in its place.
  const sheet = module("core/dom", "InlineStyleSheet")
  const write = method(sheet, "_update")
  const install = method(sheet, "install")
  const uninstall = method(sheet, "uninstall")
  const text = getter(sheet, "css")
  let unwritten = null
  const write_all = (and_then) => {
    const sheets = unwritten ?? []
    unwritten = null
    for (const [one, css] of sheets) one._update(css)
    unwritten = and_then
  }
  const written_once = (act) => {
    if (unwritten !== null) return act()
    unwritten = new Map()
    try {
      return act()
    } finally {
      write_all(null)
    }
  }
  part("style sheets that stay", [write, install, uninstall, text], () => {
    const gaps = new WeakMap()
    sheet._update = function (css) {
      if (unwritten !== null) unwritten.set(this, css)
      else if (text.call(this) !== css) write.call(this, css)
      else return
      if (css !== "") gaps.get(this)?.replaceWith(this.el)
    }
    sheet.install = function (root) {
      if (this.css !== "") return install.call(this, root)
      if (!gaps.has(this)) gaps.set(this, new Comment())
      root.append(gaps.get(this))
    }
    sheet.uninstall = function () {
      gaps.get(this)?.remove()
      uninstall.call(this)
    }
    redefine(sheet, "css", function () { return unwritten?.get(this) ?? text.call(this) })
  })

  // Each part of the page loads the style sheets of Panel for itself, a little later, and the page is
  // worked out anew as each comes: from the second part on they are there.
  const linked = module("core/dom", "ImportedStyleSheet")
  const load = method(linked, "install")
  part("style sheets that are known", [load], () => {
    const known = new Map()
    const absolute = (css, base) =>
      css.replace(/url\("(?![a-z]+:|#)([^"]*)"\)/g, (_, at) => `url("${new URL(at, base)}")`)
    const written = (css) => Object.assign(document.createElement("style"), { textContent: css })
    linked.install = function (root) {
      const link = this.el, { href } = link
      if (known.has(href)) this.el = written(known.get(href))
      else if (href) link.addEventListener("load", () => {
        const css = [...link.sheet?.cssRules ?? []].map((rule) => rule.cssText).join("\n")
        if (css === "") return
        known.set(href, absolute(css, href))
        link.replaceWith(this.el = written(known.get(href)))
      }, { once: true })
      load.call(this, root)
    }
  })

  // Whatever changes in a figure, Bokeh lays out the page: all that it shows and all tabs that have
  // ever been open, once a change. Style sheets place what is on the page: here a change lays out its
  // card, one of a card its tab, all changes of a message do so once, and what is in a closed tab is
  // laid out when that opens. A figure hears of its own size: it is laid out with those of its card,
  // whose axes are in line.
  const column = view_of("Column")
  const resized = method(column, "_after_resize")
  const heard = method(figure, "after_resize")
  const lay_out = method(column, "compute_layout")
  const measure = method(column, "measure_layout")
  const update = method(column, "update_layout")
  const update_bbox = method(column, "update_bbox")
  const compute = method(column, "_compute_layout")
  const follow = method(column, "after_layout")
  const invalidate = method(column, "invalidate_layout")
  const came = method(column, "r_after_render")
  const laid_out = getter(column, "layoutable_views")
  const needed = [resized, heard, lay_out, measure, update, update_bbox, compute, follow, invalidate, came, laid_out]
  part("layout of the page", needed, () => {
    const place = owner(column, "invalidate_layout")
    const is_figure = (view) => view instanceof figure.constructor
    const is = (view, name) => view.el.classList.contains(name)
    const is_layout = (view) => view instanceof place.constructor
    const closed = (view) => is_layout(view) && (is(view, "off-screen") || closed(view.parent))
    redefine(column, "layoutable_views", function () {
      return laid_out.call(this).filter((view) => !is(view, "off-screen"))
    })
    const lay_out_all = (view) => {
      write_all(unwritten && new Map())
      view.measure_layout()
      view.update_bbox()
      view._compute_layout()
      paint_together(() => view.after_layout())
      view._layout_computed = true
    }
    owner(column, "_after_resize")._after_resize = function () {
      if (!this._was_built || is_figure(this)) resized.call(this)
    }
    figure.after_resize = function () {
      heard.call(this)
      // what it stands in may have measured it before
      const { bbox, layout } = this
      const stale = bbox.width !== layout?.bbox.width || bbox.height !== layout?.bbox.height
      if (this._was_built && this.is_displayed && stale) this.compute_layout()
    }
    owner(column, "compute_layout").compute_layout = function () {
      if (!is(this, "view")) lay_out.call(this)
      else if (!closed(this)) lay_out_all(this)
    }

    // ... and hears of it as it comes, when it is asked how large it is already
    const come = owner(column, "r_after_render")
    come.r_after_render = function () { written_once(() => came.call(this)) }

    // What is out of the document costs nothing: styles are worked out for all that is in it.
    owner(column, "update_layout").update_layout = function () {
      const before = comes_back
      for (const { el } of this.child_views) {
        if (el.classList.contains("off-screen")) el.remove()
        else if (el.classList.contains("on-screen") && !el.isConnected) {
          this.shadow_el.append(el)
          comes_back = true  // and nothing else is in this column
        }
      }
      update.call(this)
      comes_back = before
    }

    const waiting = new Set()
    const within = (view) => is_layout(view.parent) && (waiting.has(view.parent) || within(view.parent))
    const lay_out_waiting = () => {
      const tops = [...waiting].filter((view) => view.el.isConnected && !closed(view) && !within(view))
      waiting.clear()
      written_once(() => { for (const view of tops) view.update_layout() })
      paint_together(() => { for (const view of tops) lay_out_all(view) })
    }
    place.invalidate_layout = function () {
      let top = this
      while (is_layout(top.parent) && (top === this || !is(top, "view"))) top = top.parent
      if (!top._layout_computed && !is_layout(top.parent)) {
        written_once(() => top.update_layout())
        return lay_out_all(top)
      }
      if (waiting.size === 0) queueMicrotask(lay_out_waiting)
      waiting.add(top)
    }
  })

  // Bokeh clears a canvas but for half a pixel along two of its edges, where a longer axis label or the
  // paper of the other theme would stay.
  const canvas_layer = module("core/util/canvas", "CanvasLayer")
  part("whole canvas", [method(canvas_layer, "clear")], () => {
    canvas_layer.clear = function () { this.ctx.clearRect(-1, -1, this.bbox.width + 2, this.bbox.height + 2) }
  })

  // Bokeh zooms by the whole of a pinch at each of its steps: a figure runs away where fingers part,
  // and jumps where they come together. Here it stays under them.
  const wheel = module("models/tools/gestures/wheel_zoom_tool", "WheelZoomToolView")
  const pinch = method(wheel, "_pinch")
  part("pinch", [pinch, method(wheel, "zoom")], () => {
    wheel._pinch_start = function () { this.pinched = 1 }
    wheel._pinch = function ({ sx, sy, scale }) {
      const by = scale / (this.pinched ?? 1)
      this.pinched = scale
      this.zoom(sx, sy, (1 - 1 / by) / this.model.speed)
    }
  })

  window.fast_figures = { missing }
}
