"""Faults of the page that is shown: as Chromium's own accessibility tree sees it, by faults.js, and by the focus."""

import pathlib

from selenium.webdriver.common.keys import Keys

SCRIPT = (pathlib.Path(__file__).resolve().parent / "faults.js").read_text(encoding="utf-8")
NAMED = {"button", "link", "textbox", "searchbox", "combobox", "listbox", "slider", "spinbutton", "checkbox", "radio", "switch",
         "tab", "menuitem", "progressbar", "meter", "image", "img", "Canvas", "dialog", "alertdialog", "ColorWell", "group"}
FOCUS = """
const one = document.activeElement;
if (!one || one === document.body) return null;
const target = one.matches('.unseen') ? one.labels?.[0] ?? one : one;
const style = getComputedStyle(target), box = target.getBoundingClientRect();
const text = (one.getAttribute('aria-label') ?? one.labels?.[0]?.innerText ?? one.innerText ?? '').trim().slice(0, 40);
window.seen ??= new Map();
const again = window.seen.has(one);
window.seen.set(one, true);
return {name: `<${one.localName}> "${text}"`, again, ring: style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) >= 2 || style.boxShadow !== 'none',
        ink: style.outlineColor, there: box.width > 0 && box.bottom > 0 && box.top < innerHeight && box.right > 0 && box.left < innerWidth};
"""


def of_names(browser):
    found = []
    for node in browser.cdp("Accessibility.getFullAXTree")["nodes"]:
        role = node.get("role", {}).get("value")
        if node.get("ignored") or role not in NAMED:
            continue
        focusable = any(one["name"] == "focusable" and one["value"]["value"] for one in node.get("properties", []))
        if role == "group" and not focusable:
            continue
        if not node.get("name", {}).get("value", "").strip():
            html = browser.cdp("DOM.describeNode", backendNodeId=node["backendDOMNodeId"])["node"]
            found.append(f"a {role} without a name: <{html.get('localName')} {' '.join(html.get('attributes', []))}>"[:200])
    return found


def of_focus(browser, most=200):
    """Goes through the page with Tab, until it comes round."""
    browser.js("window.seen = undefined; document.activeElement?.blur(); window.scrollTo(0, 0)")
    found = []
    for _ in range(most):
        browser.key(Keys.TAB)
        at = browser.js(FOCUS)
        if at is None or at["again"]:
            return found
        if not at["ring"]:
            found.append(f"the focus on {at['name']} is not seen")
        if not at["there"]:
            found.append(f"{at['name']} has the focus out of sight")
    return [*found, "Tab does not come round"]


def of_page(browser):
    return of_names(browser) + browser.js(SCRIPT)
