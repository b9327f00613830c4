"""What only the browser knows: keys that are pressed anywhere on the page, and which theme its user wants.

The theme that was chosen last is kept in the browser's own storage; before any was chosen, the one that the
operating system asks for is taken. Nothing is drawn here.
"""

import panel as pn
import param


class Browser(pn.custom.JSComponent):
    """Listens to the browser; it has no size."""

    undone = param.Integer(default=0, doc="How often undo was asked for by key.")
    redone = param.Integer(default=0, doc="How often redo was asked for by key.")

    _esm = """
    const KEY = "trackig-theme"

    function wanted() {
      try {
        const kept = localStorage.getItem(KEY)
        if (kept !== null) { return kept === "dark" }
      } catch { /* storage may be forbidden */ }
      return matchMedia("(prefers-color-scheme: dark)").matches
    }

    function keep(dark) {
      try { localStorage.setItem(KEY, dark ? "dark" : "light") } catch { /* as above */ }
    }

    function follow_theme(page) {
      if (page.class_name !== "Page") { return }
      page.data.properties.dark_theme.change.connect(() => keep(page.data.dark_theme))
      if (wanted() !== page.data.dark_theme) { setTimeout(() => { page.data.dark_theme = wanted() }, 0) }
    }

    function is_text(target) {
      if (target?.isContentEditable || target?.tagName === "TEXTAREA") { return true }
      return target?.tagName === "INPUT" && !["range", "checkbox", "radio", "button"].includes(target.type)
    }

    export function render({model, view}) {
      const press = event => {
        if (!(event.ctrlKey || event.metaKey) || event.altKey || is_text(event.composedPath()[0])) { return }
        const key = event.key.toLowerCase()
        if (key === "y" || (key === "z" && event.shiftKey)) { model.redone += 1 }
        else if (key === "z") { model.undone += 1 }
        else { return }
        event.preventDefault()
      }
      document.addEventListener("keydown", press)
      model.on("remove", () => document.removeEventListener("keydown", press))
      follow_theme(view.root.model)
      return document.createElement("div")
    }
    """
