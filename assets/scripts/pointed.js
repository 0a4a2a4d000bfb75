// Rolling elements that are pointed at, in a figure or in a sentence, light up wherever they are drawn:
// in all sources with a column `element`. A negative number there is met by every element in turn.
addEventListener("explorer-pointed", ({ detail: elements }) => {
  for (const { model } of Bokeh.index.query(({ model }) => model.hover_glyph && model.data_source.data.element)) {
    const { data_source: source } = model, { element } = source.data
    source.inspected.indices = [...element.keys()].filter((i) => elements.length && (element[i] < 0 || elements.includes(element[i])))
    source.inspect.emit([model, {}])
  }
})
