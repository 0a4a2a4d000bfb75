// An element of the page with its attributes and children; "html" is its content, written out by us.
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag)
  for (const [name, value] of Object.entries(attributes))
    name === "html" ? (made.innerHTML = value) : made.setAttribute(name, value)
  made.append(...children)
  return made
}

