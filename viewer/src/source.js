// Where the run comes from: elements of this page (a player in one file), or the server that sent it.

/** @param {string} text base 64 @returns {Uint8Array} */
function fromBase64(text) {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let n = 0; n < letters.length; ++n) bytes[n] = letters.charCodeAt(n);
  return bytes;
}

export class Source {
  constructor() {
    this.elements = new Map();
    for (const element of document.querySelectorAll('script[data-name]'))
      this.elements.set(element.dataset.name, element);
  }

  get isEmbedded() { return this.elements.size > 0; }

  /** @param {string} name such as "moments/12" @returns {Promise<Uint8Array>} */
  async bytes(name) {
    if (this.isEmbedded) {
      const element = this.elements.get(name);
      if (!element) throw new Error(`${name} is not in this file`);
      const bytes = fromBase64(element.textContent);
      if (name.startsWith('moments/')) this.elements.delete(name), element.remove();  // it is asked for once
      return bytes;
    }
    const answer = await fetch(`data/${name}`);
    if (!answer.ok) throw new Error((await answer.text()).trim() || `${name}: ${answer.status}`);
    return new Uint8Array(await answer.arrayBuffer());
  }

  async json(name) { return parsed(await this.bytes(name)); }
}

/** @param {Uint8Array} bytes of JSON */
export function parsed(bytes) { return JSON.parse(new TextDecoder().decode(bytes)); }
