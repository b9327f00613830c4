// What the server cannot do without the browser: the address bar, the clipboard, files, and a memory that outlives the server.
//
// What is kept is never overwritten before it was offered to a server that does not know it.

const MEMORY = "trackig"
const CATALOGUE = "trackig-catalogue"
const LONGEST_CATALOGUE = 262144 // characters that are sent back
const LOOK_EVERY = 500 // ms between looks whether the server is back
const RECOLOURED = 100 // ms after which recolouring has begun
const REVEALED = 30000 // ms after which a part that is not there is given up
const SETTLED = 10000 // ms without a move of a part, after which it is taken to stay where it is
const GAP = 40 // ms between looks whether the page is at work
const PATIENCE = 1500 // ms after which the page is shown as it is; browsers give up after 4000

const pause = (time) => new Promise((resolve) => setTimeout(resolve, time))

function remembered() {
  try {
    return JSON.parse(sessionStorage.getItem(MEMORY))
  } catch {
    return null
  }
}

function keep(model) {
  const [query, study, typed] = model.kept
  if (query === "") return
  history.replaceState(null, "", `${location.pathname}?${query}`)
  try {
    const memory = {session: model.session, query: location.search, study, typed}
    sessionStorage.setItem(MEMORY, JSON.stringify(memory))
  } catch {
    // a browser that refuses to remember still has the address bar
  }
}

function resume(model) {
  const memory = remembered()
  const ours = memory !== null && memory.session !== model.session && memory.query === location.search
  if (ours && (memory.study !== model.kept[1] || memory.typed !== model.kept[2])) {
    model.send_msg({kind: "restore", data: memory.study, typed: memory.typed ?? ""})
  } else {
    keep(model)
  }
}

// The catalogue of a company stays with the browser, whatever page it opens next.
function remember(text) {
  try {
    if (text === "") localStorage.removeItem(CATALOGUE)
    else localStorage.setItem(CATALOGUE, text)
  } catch {
    // a browser that refuses to remember has the file
  }
}

function recall(model) {
  try {
    const data = localStorage.getItem(CATALOGUE)
    if (data !== null && data.length <= LONGEST_CATALOGUE) model.send_msg({kind: "recalled", data})
  } catch {
    // nothing is remembered
  }
}

async function copied(text) {
  try {
    await navigator.clipboard.writeText(text)
    return true
  } catch {
    // pages that are not served over HTTPS have no clipboard, but they have this
    const box = document.createElement("textarea")
    box.value = text
    document.body.append(box)
    box.select()
    const done = document.execCommand("copy")
    box.remove()
    return done
  }
}

// The address bar may not have followed the last changes yet. Still, what it holds is copied at once, since some
// browsers let a page copy at a click alone; and once more if the server says that there was more to come.
function linkCopier(model) {
  let last = {text: "", done: false}
  const copy = async () => {
    const text = location.href
    if (text !== last.text || !last.done) last = {text, done: await copied(text)}
  }
  return {
    async begin() {
      last = {text: "", done: false}
      await copy()
      model.send_msg({kind: "copying"})
    },
    async end() {
      await copy()
      model.send_msg({kind: "copied", data: last.done})
    },
  }
}

// Bring a part of the page into sight that may be made only now, and hold it there while what stands above it is still
// being drawn; whoever scrolls, clicks or types meanwhile goes on from where that leads.
async function reveal(document, name) {
  const theirs = new AbortController()
  const leave = () => theirs.abort()
  for (const sign of ["wheel", "touchmove", "pointerdown", "keydown"])
    window.addEventListener(sign, leave, {capture: true, passive: true, signal: theirs.signal})
  let top = null
  let until = performance.now() + REVEALED
  for (; performance.now() < until && !theirs.signal.aborted; await pause(RECOLOURED)) {
    const model = document.get_model_by_name(name)
    const part = model === null ? null : Bokeh.index.find_one(model)?.el
    if (!part?.checkVisibility() || part.getBoundingClientRect().top === top) continue
    part.scrollIntoView({block: "start"})
    top = part.getBoundingClientRect().top
    until = performance.now() + SETTLED
  }
  leave()
}

function save(name, blob) {
  const link = document.createElement("a")
  link.href = URL.createObjectURL(blob)
  link.download = name
  document.body.append(link)
  link.click()
  link.remove()
  setTimeout(() => URL.revokeObjectURL(link.href), 60000)
}

function choose(model, purpose, accept, most) {
  const input = document.createElement("input")
  input.type = "file"
  input.accept = accept
  input.hidden = true
  document.body.append(input)
  input.addEventListener("cancel", () => input.remove())
  input.addEventListener("change", async () => {
    // of a file that is too large, enough is sent to tell
    const data = await input.files[0].slice(0, most + 1).arrayBuffer()
    model.send_msg({kind: purpose, data})
    input.remove()
  })
  input.click()
}

// When the theme is switched, Panel recolours text at once and the paper behind it part by part, some seconds later on
// a slow machine: white on white. Until nothing is left to do, the picture stays as it was.
function switchThemeAsAWhole(event) {
  const toggle = event.composedPath().find((each) => each.getAttribute?.("aria-label") === "Toggle theme")
  if (toggle === undefined || !event.isTrusted || document.startViewTransition === undefined) return
  event.stopImmediatePropagation()
  event.preventDefault()
  const change = document.startViewTransition(async () => {
    toggle.click()
    await pause(RECOLOURED)
    const patience = performance.now() + PATIENCE
    for (let idle = 0; idle < 3 && performance.now() < patience; ) {
      const before = performance.now()
      await pause(GAP)
      idle = performance.now() - before < 2 * GAP ? idle + 1 : 0
    }
  })
  change.updateCallbackDone.then(() => change.skipTransition())
}

// What takes the keyboard's focus in a figure has no name, and its tools are shown to the mouse alone.
function nameFigure(model, canvas) {
  const figure = canvas.plot_views[0]
  const layer = canvas.events_el
  if (figure === undefined || layer.role !== null) return
  const {"aria-label": label, "aria-keyshortcuts": keys} = Object.fromEntries(entries(figure.model.html_attributes))
  layer.role = keys === undefined ? "group" : "application"
  layer.ariaLabel = label ?? "Figure"
  const toolbar = () => [...figure.renderer_views.values()].find((each) => each.toolbar_view)?.toolbar_view
  figure.el.addEventListener("focusin", () => {
    toolbar()?.set_visibility(true)
    for (const {el, model: {type}} of toolbar()?.tool_button_views ?? []) {
      el.role = "button"
      // the others need a pointer
      if (type !== "ClickButton") el.tabIndex = -1
    }
  })
  figure.el.addEventListener("focusout", () => toolbar()?.set_visibility(figure.el.matches(":hover")))
  layer.addEventListener("keydown", (event) => {
    if (!keys?.split(" ").includes(event.key) || event.ctrlKey || event.altKey || event.metaKey) return
    event.preventDefault()
    model.send_msg({kind: "key", figure: figure.model.name, key: event.key, shift: event.shiftKey})
  })
}

const entries = (given) => (given instanceof Map ? given : Object.entries(given))

// The thumb of a slider tells its value, and not of what.
function nameSlider(slider) {
  for (const thumb of slider.shadow_el.querySelectorAll("[role=slider]")) thumb.ariaLabel = slider.model.title
}

// Have something done to all views of a model of Bokeh: as they are drawn, and to those that were drawn before.
function onDrawn(type, act) {
  const {default_view} = Bokeh.Models.get(type).prototype
  const {render} = default_view.prototype
  default_view.prototype.render = function () {
    render.call(this)
    act(this)
  }
  for (const view of Bokeh.index.query((each) => each instanceof default_view)) act(view)
}

// Words that change are drawn anew: what of them has the keyboard's focus, such as the status line, keeps it.
function keepFocus() {
  const {prototype} = Bokeh.Models.get("panel.models.markup.HTML").prototype.default_view
  const {set_html} = prototype
  prototype.set_html = function (...rest) {
    const parts = () => [...(this.container?.querySelectorAll("[tabindex]") ?? [])]
    const focused = parts().indexOf(this.shadow_el.activeElement)
    set_html.apply(this, rest)
    parts()[focused]?.focus({preventScroll: true})
  }
}

// Bokeh would take up a session where it was, but loses the arrays in it, and would fill this page with that of a
// restarted server, made for the address as it was at first. Loaded anew, the page comes back as it is now.
async function comeBack() {
  const file = document.querySelector("script[src*='static/']").src
  for (;;) {
    await pause(LOOK_EVERY)
    try {
      if ((await fetch(file, {method: "HEAD", cache: "no-store"})).ok) break
    } catch {
      // not yet
    }
  }
  location.reload()
}

export function render({model, view}) {
  const answer = () => model.send_msg({kind: "introduced"})
  const link = linkCopier(model)
  model.on("kept", () => {
    keep(model)
    answer()
  })
  model.on("msg:custom", (message) => {
    if (message.kind === "keep") keep(model)
    if (message.kind === "copied") link.end()
    if (message.kind === "introduce") answer()
    if (message.kind === "reveal") reveal(view.model.document, message.name)
    if (message.kind === "remember") remember(message.data)
    if (message.kind === "save") save(message.name, new Blob([message.data], {type: message.type}))
  })
  view.model.document.on_event("connection_lost", comeBack)
  document.addEventListener("click", switchThemeAsAWhole, true)
  window.trackig = {
    copyLink: link.begin,
    choose: (...rest) => choose(model, ...rest),
  }
  onDrawn("Canvas", (canvas) => nameFigure(model, canvas))
  onDrawn("Slider", nameSlider)
  keepFocus()
  resume(model)
  recall(model)
  return document.createElement("span")
}
