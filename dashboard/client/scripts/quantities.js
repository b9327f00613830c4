// The panel of quantities: a slider and a box for each number, with choices and switches between them.
//
// Slider and box follow each other here, without the server. What the hand sets goes to the server one message
// at a time: the newest values leave when the picture of the last ones has been drawn, at once when none is due,
// and at once when the hand lets go, so that whatever it does next finds them there.

const PATIENCE = 3000 // ms after which an answer counts as lost
const PAUSE = 1000 // ms without a key after which the next one is a gesture of its own
const STEPS_PER_DECADE = 100
const SLIDER_FIGURES = 3 // to which a logarithmic slider rounds
const FIGURES = 6
const LENGTH = 168 // px of a slider in the sidebar
const CHARACTER = 8 // px of a digit on the buttons below it
const BORDER = 14 // px of such a button beside its digits
const KEYS = {ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1, PageUp: 10, PageDown: -10}
const UPRIGHT_KEYS = ["ArrowUp", "ArrowDown", "PageUp", "PageDown"]
const PLAIN = /^[0-9]{1,15}([.][0-9]{0,15})?$/

function element(name, properties = {}, ...children) {
  const made = document.createElement(name)
  for (const [key, value] of Object.entries(properties)) {
    if (key.includes("-") || key === "role") made.setAttribute(key, value)
    else made[key] = value
  }
  made.append(...children)
  return made
}

const rounded = (value, figures) => Number(value.toPrecision(figures))
const numberText = (value) => String(rounded(value, FIGURES))

// Shares of a slider's length at which words stand that would cover each other at their own.
function apart(shares, words) {
  const half = words.map((text) => (CHARACTER * text.length + BORDER) / 2 / LENGTH)
  const places = [...shares]
  for (let each = 1; each < places.length; each += 1)
    places[each] = Math.max(places[each], places[each - 1] + half[each - 1] + half[each])
  for (let each = places.length - 2; each >= 0; each -= 1) {
    places[each + 1] = Math.min(places[each + 1], 1)
    places[each] = Math.min(places[each], places[each + 1] - half[each + 1] - half[each])
  }
  return places
}

// What goes to the server, and when.
class Flow {
  constructor(model) {
    this.model = model
    this.number = model.state.number
    this.answered = this.number
    this.waiting = new Map()
    this.sent = new Map()
    this.gesture = 0
  }

  begin() {
    this.gesture += 1
    this.pressed = undefined
  }

  // Keys that follow each other are one gesture.
  press() {
    const now = performance.now()
    if (this.pressed === undefined || now - this.pressed > PAUSE) this.begin()
    this.pressed = now
  }

  // Whether a state of the server is older than what the hand has set of an input.
  isAhead(name, number) {
    return this.waiting.has(name) || (this.sent.get(name) ?? 0) > number
  }

  offer(name, value) {
    this.waiting.set(name, value)
    if (this.answered === this.number) this.send()
  }

  send() {
    if (this.waiting.size === 0) return
    this.number += 1
    for (const name of this.waiting.keys()) this.sent.set(name, this.number)
    const values = Object.fromEntries(this.waiting)
    this.model.send_msg({kind: "set", number: this.number, values, gesture: this.gesture})
    this.waiting.clear()
    clearTimeout(this.timer)
    this.timer = setTimeout(() => this.answer(this.number), PATIENCE)
  }

  // Answers to messages that others have followed free nothing: the newest is still being drawn.
  answer(number) {
    if (number !== this.number) return
    clearTimeout(this.timer)
    this.answered = number
    this.send()
  }
}

// Places on a slider count in steps, or in hundredths of a decade.
class Scale {
  constructor({low, high, step, logarithmic}) {
    Object.assign(this, {low, high, step, logarithmic})
  }

  position(value) {
    if (this.logarithmic) return STEPS_PER_DECADE * Math.log10(value / this.low)
    return (value - this.low) / this.step
  }

  value(position) {
    const value = this.logarithmic
      ? rounded(this.low * 10 ** (position / STEPS_PER_DECADE), SLIDER_FIGURES)
      : rounded(this.low + Math.round(position) * this.step, FIGURES)
    return Math.min(Math.max(value, this.low), this.high)
  }

  share(value) {
    return Math.min(Math.max(this.position(value) / this.position(this.high), 0), 1)
  }

  includes(value) {
    return this.low <= value && value <= this.high
  }

  // A study may hold values that no slider was made for.
  reaching(value) {
    if (this.includes(value) || (this.logarithmic && value <= 0)) return this
    return new Scale({...this, low: Math.min(this.low, value), high: Math.max(this.high, value)})
  }
}

// A button, and the words that it shows.
function helpOf(field) {
  const words = element("p", {className: "words", id: `words-${field.name}`, hidden: true}, field.words)
  const button = element(
    "button",
    {
      type: "button", className: "help", title: field.words, "aria-label": `About ${field.label}`,
      "aria-expanded": "false", "aria-controls": words.id,
    },
    "?",
  )
  button.addEventListener("click", () => {
    words.hidden = !words.hidden
    button.setAttribute("aria-expanded", String(!words.hidden))
  })
  return [button, words]
}

class Quantity {
  constructor(field, flow, model) {
    this.field = field
    this.flow = flow
    this.own = this.scale = new Scale(field)
    this.stretches = []
    this.slider = element("input", {type: "range", min: 0, step: "any", "aria-label": field.labelled})
    this.box = element("input", {
      type: "text", inputMode: "decimal", maxLength: 40, autocomplete: "off", spellcheck: false,
      "aria-label": `${field.labelled}: type a number`, "aria-describedby": `advice-${field.name}`,
      placeholder: field.blank ?? "",
    })
    this.fill = element("div", {className: "fill"})
    this.mark = element("div", {className: "mark", hidden: true})
    this.stretch = element("div", {className: "stretches", hidden: true})
    // edges come while a hand is at the sliders: their room is there before, so that no slider moves under it
    this.edges = element("div", {className: "edges", hidden: !field.ranged})
    this.track = element(
      "div", {className: "track"},
      element("div", {className: "scale"}, element("div", {className: "rail"}), this.fill, this.stretch, this.mark),
      this.slider,
    )
    this.chip = element("button", {type: "button", className: "chip", hidden: true})
    this.chip.addEventListener("click", () => model.send_msg({kind: "chip", name: field.name}))
    const unitClass = field.unit.includes(" ") ? "unit wide" : "unit"
    this.unit = element("span", {className: unitClass, "aria-hidden": "true"}, field.unit)
    this.frame = element("div", {className: "box"}, this.box, this.unit)
    this.advice = element("p", {className: "advice", id: `advice-${field.name}`, "aria-live": "polite"})
    const [help, words] = helpOf(field)
    this.root = element(
      "div", {className: "quantity"},
      element("div", {className: "name"}, element("span", {className: "label"}, field.label), help),
      this.track, this.chip, this.frame, this.edges, words, this.advice,
    )
    this.listen()
  }

  listen() {
    const release = () => this.flow.send()
    this.slider.addEventListener("pointerdown", () => this.flow.begin())
    this.slider.addEventListener("input", () => this.move(this.slider.valueAsNumber))
    this.slider.addEventListener("change", release)
    this.slider.addEventListener("keyup", release)
    this.slider.addEventListener("keydown", (event) => this.press(event, KEYS, {Home: this.scale.low, End: this.scale.high}))
    this.box.addEventListener("keyup", release)
    this.box.addEventListener("change", () => this.commit())
    this.box.addEventListener("blur", () => this.commit())
    this.box.addEventListener("keydown", (event) => {
      if (event.key === "Enter") this.commit()
      else if (event.key === "Escape") {
        this.box.value = this.text()
        this.commit()
      } else if (UPRIGHT_KEYS.includes(event.key)) this.press(event, KEYS, {})
    })
  }

  press(event, steps, ends) {
    if (event.ctrlKey || event.metaKey || event.altKey || this.value === null) return
    if (event.key in ends || event.key in steps) this.flow.press()
    const many = event.shiftKey && event.key.startsWith("Arrow") ? 10 : 1
    if (event.key in ends) this.set(ends[event.key])
    else if (event.key in steps) this.move(this.scale.position(this.value) + many * steps[event.key])
    else return
    event.preventDefault()
  }

  // Follow the thumb, which is left where it is.
  move(position) {
    const value = this.scale.value(position)
    if (this.slider.valueAsNumber !== position) this.slider.value = position
    if (value === this.value && this.advice.textContent === "") return
    this.take(value)
    this.flow.offer(this.field.name, value)
  }

  // Go to a value, and have the server follow at once.
  set(value) {
    this.place(value)
    this.take(value)
    this.flow.offer(this.field.name, value)
    this.flow.send()
  }

  // What is no plain number within reach is the server's to read.
  commit() {
    const typed = this.box.value
    if (typed === this.committed) return
    this.committed = typed
    this.flow.begin()
    const value = Number(typed)
    if (PLAIN.test(typed) && this.scale.includes(value)) {
      this.place(value)
      this.take(value, typed)
    }
    this.flow.offer(this.field.name, typed)
    this.flow.send()
  }

  // What may be left empty has no value then, and no slider.
  text() {
    return this.value === null ? "" : numberText(this.value)
  }

  take(value, text = undefined) {
    this.value = value
    this.box.value = this.committed = text ?? this.text()
    this.slider.setAttribute("aria-valuetext", this.text())
    if (value !== null) this.fill.style.width = `${100 * this.scale.share(value)}%`
    this.refuse("")
  }

  place(value) {
    this.root.classList.toggle("blank", value === null)
    if (value === null) return
    const scale = this.own.reaching(value)
    if (scale !== this.scale) {
      this.scale = scale
      this.slider.max = scale.position(scale.high)
      this.draw()
    }
    this.slider.max = this.scale.position(this.scale.high)
    this.slider.value = this.scale.position(value)
  }

  refuse(advice) {
    this.advice.textContent = advice
    if (advice === "") this.box.removeAttribute("aria-invalid")
    else this.box.setAttribute("aria-invalid", "true")
  }

  // Show what the server knows; what somebody is typing, and a thumb that stands where it gives this value, stay.
  show({values, refused, disabled, hidden, marks}) {
    const value = values[this.field.name]
    const advice = refused[this.field.name] ?? ""
    const typing = this.box.matches(":focus") && this.box.value !== this.committed
    if (value !== undefined && value !== this.value) this.place(value)
    if (value !== undefined && advice === "" && !typing) this.take(value)
    this.refuse(advice)
    this.root.hidden = hidden.includes(this.field.name)
    this.root.classList.toggle("disabled", disabled.includes(this.field.name))
    this.slider.disabled = this.box.disabled = disabled.includes(this.field.name)
    this.preset = marks[this.field.name]
    this.draw()
  }

  showStretches(stretches) {
    this.stretches = stretches
    this.draw()
  }

  showChip(words) {
    this.chip.hidden = words === undefined
    this.track.hidden = this.frame.hidden = words !== undefined
    this.chip.textContent = words ?? ""
    this.chip.setAttribute("aria-label", `${this.field.label}: ${words ?? ""}`)
  }

  draw() {
    this.mark.hidden = this.preset === undefined
    if (this.preset !== undefined) this.mark.style.left = `${100 * this.scale.share(this.preset)}%`
    if (this.value !== null) this.fill.style.width = `${100 * this.scale.share(this.value)}%`
    this.stretch.hidden = this.stretches === undefined
    this.stretch.replaceChildren(...(this.stretches ?? []).map(([low, high]) => this.stretchOf(low, high)))
    this.drawEdges()
  }

  stretchOf(low, high) {
    const drawn = element("div", {className: "stretch"})
    drawn.style.left = `${100 * this.scale.share(low)}%`
    drawn.style.right = `${100 * (1 - this.scale.share(high))}%`
    drawn.classList.toggle("begins", low > this.scale.low)
    drawn.classList.toggle("ends", high < this.scale.high)
    return drawn
  }

  drawEdges() {
    const edges = (this.stretches ?? []).flat().filter((edge) => this.scale.low < edge && edge < this.scale.high)
    const key = String([...edges, this.scale.low, this.scale.high])
    // a button that is pressed must not be replaced under the pointer
    if (key === this.edgesDrawn) return
    this.edgesDrawn = key
    const unit = this.field.unit === "" ? "" : ` ${this.field.unit}`
    const buttons = edges.map((edge) => {
      const label = `Set ${this.field.label} to ${numberText(edge)}${unit}, the edge of what complies`
      const button = element("button", {type: "button", className: "edge", "aria-label": label}, numberText(edge))
      button.addEventListener("click", () => {
        this.flow.begin()
        this.set(edge)
      })
      return button
    })
    const places = apart(edges.map((edge) => this.scale.share(edge)), buttons.map((button) => button.textContent))
    buttons.forEach((button, number) => { button.style.left = `${100 * places[number]}%` })
    this.edges.replaceChildren(...buttons)
  }
}

class Choice {
  constructor(field, flow) {
    this.field = field
    const options = field.options.map(([words, value]) => element("option", {value}, words))
    this.select = element("select", {"aria-label": field.label}, ...options)
    this.select.addEventListener("change", () => {
      // another track replaces whatever has not left yet
      if (field.replaces) flow.waiting.clear()
      flow.begin()
      flow.offer(field.name, this.select.value)
      flow.send()
    })
    const label = element("span", {className: "over", "aria-hidden": "true"}, field.label)
    this.root = element("div", {className: "choice"}, label, this.select, ...(field.words === undefined ? [] : helpOf(field)))
    this.root.classList.toggle("explained", field.words !== undefined)
  }

  // What can only be given, not chosen, is offered while it is there.
  show({values, words}) {
    const value = values[this.field.name]
    for (const option of this.select.options) option.hidden = option.value === this.field.given && option.value !== value
    this.select.value = value
    this.field.options.forEach(([usual], number) => {
      const option = this.select.options[number]
      option.textContent = option.selected ? words[this.field.name] ?? usual : usual
    })
  }
}

class Switch {
  constructor(field, flow) {
    this.field = field
    this.box = element("input", {type: "checkbox", role: "switch"})
    this.box.addEventListener("change", () => {
      flow.begin()
      flow.offer(field.name, this.box.checked)
      flow.send()
    })
    this.root = element("label", {className: "switch"}, this.box, element("span", {}, field.label))
  }

  show({values}) {
    this.box.checked = values[this.field.name]
  }
}

// Whether the design is the one that was chosen, and the way back to it.
class Departure {
  constructor(field, flow, model) {
    this.words = element("span", {className: "state"})
    this.back = element("button", {type: "button", className: "back"}, field.label)
    this.back.addEventListener("click", () => {
      flow.waiting.clear()
      model.send_msg({kind: "revert"})
    })
    this.root = element("div", {className: "departure"}, this.words, this.back)
  }

  show({modified}) {
    this.words.textContent = modified ? "Modified" : "As in Table 1"
    this.words.classList.toggle("modified", modified)
    this.back.disabled = !modified
  }
}

const KINDS = {number: Quantity, choice: Choice, switch: Switch, departure: Departure}

// What may be chosen for a group from the catalogue; it holds no choice, since sliders go on from there.
class Pick {
  constructor({title, kinds}, flow, model) {
    this.kinds = kinds
    this.root = element("select", {className: "pick", "aria-label": `${title}: from the catalogue`, hidden: true})
    this.root.addEventListener("change", () => {
      const {of, name} = this.root.selectedOptions[0].dataset
      this.root.selectedIndex = 0
      flow.waiting.clear()
      model.send_msg({kind: "pick", of, name})
    })
  }

  show(catalogue) {
    const options = this.kinds.map((of) => {
      const names = (catalogue[of] ?? []).map((name) => {
        const option = element("option", {}, name)
        Object.assign(option.dataset, {of, name})
        return option
      })
      return element("optgroup", {label: of}, ...names)
    })
    const head = element("option", {disabled: true, selected: true}, "from catalogue")
    this.root.replaceChildren(head, ...options.filter((each) => each.children.length > 0))
    this.root.hidden = this.root.children.length === 1
    this.root.selectedIndex = 0
  }
}

function groupOf({title, closed}, rows, pick) {
  if (title === "") return element("div", {className: "group"}, ...rows)
  const summary = element("summary", {}, title, ...(pick === undefined ? [] : [pick.root]))
  return element("details", {className: "group", open: !closed}, summary, ...rows)
}

export function render({model}) {
  const flow = new Flow(model)
  const rows = new Map()
  const picks = []
  const groups = model.groups.map((group) => {
    const made = group.fields.map((field) => new KINDS[field.kind](field, flow, model))
    made.forEach((row) => rows.set(row.field?.name ?? "", row))
    const pick = group.kinds.length > 0 ? new Pick(group, flow, model) : undefined
    if (pick !== undefined) picks.push(pick)
    return groupOf(group, made.map((row) => row.root), pick)
  })
  const panel = element("div", {className: "panel"}, ...groups)

  function show() {
    const state = model.state
    for (const [name, row] of rows) if (!flow.isAhead(name, state.number)) row.show(state)
  }
  const quantities = () => [...rows.values()].filter((row) => row instanceof Quantity)
  const showStretches = () => quantities().forEach((row) => row.showStretches(model.feasible[row.field.name]))
  const showStale = () => panel.classList.toggle("stale", Boolean(model.stale))
  const showChips = () => quantities().forEach((row) => row.showChip(model.chips[row.field.name]))
  const showPicks = () => picks.forEach((pick) => pick.show(model.catalogue))

  model.on("state", show)
  model.on("feasible", showStretches)
  model.on("stale", showStale)
  model.on("chips", showChips)
  model.on("catalogue", showPicks)
  model.on("msg:custom", (message) => {
    if (message.kind === "answered") flow.answer(message.number)
  })
  show()
  showStretches()
  showStale()
  showChips()
  showPicks()
  return panel
}
