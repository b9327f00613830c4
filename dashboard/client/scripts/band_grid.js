// A table of one row per band: a box for the value that the user gives, and what came of it per design.
//
// Text is set as text, never as markup, and a box in which somebody types is left alone.

function element(name, words = "", properties = {}) {
  const made = Object.assign(document.createElement(name), properties)
  made.textContent = words
  return made
}

function headers(model) {
  const names = element("tr")
  const parts = element("tr")
  for (const words of ["Band, Hz", model.given]) names.append(element("th", words, {scope: "col", rowSpan: 2}))
  for (const design of model.designs) {
    const cell = element("th", "", {scope: "colgroup", colSpan: design.parts.length})
    cell.append(swatch(design.colour, design.dash), element("span", design.name, {className: "name"}))
    names.append(cell)
    parts.append(...design.parts.map(({words}) => element("th", words, {scope: "col"})))
  }
  return [names, parts]
}

function swatch(colour, dash) {
  const space = "http://www.w3.org/2000/svg"
  const drawing = document.createElementNS(space, "svg")
  const line = document.createElementNS(space, "line")
  drawing.setAttribute("viewBox", "0 0 34 6")
  drawing.setAttribute("aria-hidden", "true")
  for (const [key, value] of Object.entries({x1: 0, x2: 34, y1: 3, y2: 3, stroke: colour, "stroke-width": 4}))
    line.setAttribute(key, value)
  line.setAttribute("stroke-dasharray", dash.join(" "))
  drawing.append(line)
  return drawing
}

export function render({model}) {
  const table = element("table")
  const head = element("thead")
  const body = element("tbody")
  const caption = element("caption", model.words)
  table.append(caption, head, body)
  const boxes = model.bands.map((band, place) => {
    const box = element("input", "", {type: "text", inputMode: "decimal", maxLength: 24, autocomplete: "off"})
    box.setAttribute("aria-label", `${model.given}, ${band} Hz`)
    box.addEventListener("change", () => model.send_msg({kind: "typed", band: place, text: box.value}))
    box.addEventListener("keydown", (event) => {
      const step = {ArrowDown: 1, Enter: 1, ArrowUp: -1}[event.key]
      if (step === undefined) return
      event.preventDefault()
      boxes[place + step]?.select()
      boxes[place + step]?.focus()
    })
    box.addEventListener("paste", (event) => {
      const text = event.clipboardData.getData("text")
      if (!/[\t\n\r]/.test(text.trim())) return
      event.preventDefault()
      model.send_msg({kind: "pasted", band: place, text: text.slice(0, model.most + 1)})
    })
    return box
  })
  const rows = model.bands.map((band, place) => {
    const row = element("tr")
    const cell = element("td")
    cell.append(boxes[place])
    row.append(element("th", band, {scope: "row"}), cell)
    return row
  })
  body.append(...rows)

  function show() {
    head.replaceChildren(...headers(model))
    rows.forEach((row, place) => {
      while (row.children.length > 2) row.lastChild.remove()
      for (const {cells} of model.designs.flatMap(({parts}) => parts)) {
        const [words, fails] = cells[place]
        row.append(element("td", words, {className: fails ? "fails" : ""}))
      }
    })
  }

  function showValues() {
    boxes.forEach((box, place) => {
      box.value = model.values[place]
      box.removeAttribute("aria-invalid")
    })
  }

  model.on("designs", show)
  model.on("values", showValues)
  model.on("msg:custom", (message) => {
    if (message.kind === "refused") boxes[message.band].setAttribute("aria-invalid", "true")
    if (message.kind === "again") showValues()
  })
  show()
  showValues()
  return table
}
