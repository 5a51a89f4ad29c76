// The widgets of one panel as the page has them: each is a model with a state, as anywidget's scripts
// expect it, and all of them share one conversation with their panel in Python.

import { ask } from "./python.js";

export class Model {
  #listeners = new Map();
  #unsaved = new Set();

  constructor({ id, kind, state, script, style }, panel) {
    Object.assign(this, { id, kind, script, style, panel, state: {} });
    panel.models.set(id, this);
    for (const [name, value] of Object.entries(state)) this.state[name] = this.#revived(value);
  }

  // What is described in a state is a widget itself.
  #revived(value) {
    if (Array.isArray(value)) return value.map((each) => this.#revived(each));
    return value?.kind && value?.state ? new Model(value, this.panel) : value;
  }

  get(name) {
    return this.state[name];
  }

  set(name, value) {
    if (this.state[name] === value) return;
    this.state[name] = value;
    this.#unsaved.add(name);
    this.#fire(`change:${name}`);
  }

  save_changes() {
    for (const name of this.#unsaved) this.panel.change(this.id, name, this.state[name]);
    this.#unsaved.clear();
  }

  send(message) {
    this.panel.say(this.id, message);
  }

  on(event, listener) {
    if (!this.#listeners.has(event)) this.#listeners.set(event, new Set());
    this.#listeners.get(event).add(listener);
  }

  off(event, listener) {
    this.#listeners.get(event)?.delete(listener);
  }

  // Python says what the state is now.
  take(name, value) {
    if (this.state[name] === value) return;
    this.state[name] = this.#revived(value);
    this.#fire(`change:${name}`);
  }

  // Python, or a part of it, says something to the script.
  hear(message) {
    this.#fire("msg:custom", message);
  }

  #fire(event, ...what) {
    for (const listener of [...(this.#listeners.get(event) ?? [])]) listener(...what);
  }
}

// One panel's conversation with Python. What the reader does while Python is at work is put together:
// of each value only the last is sent.
export class Conversation {
  models = new Map();
  #changes = new Map(); // "widget name" -> [widget, name, value]
  #messages = [];
  #going = false;
  #ended = false;

  // onBusy(true or false), onNews({values}), onTrouble(error)
  constructor({ panel, widget }, { onBusy, onNews, onTrouble }) {
    this.number = panel;
    Object.assign(this, { onBusy, onNews, onTrouble });
    this.root = new Model(widget, this);
  }

  change(id, name, value) {
    this.#changes.set(`${id} ${name}`, [id, name, value]);
    this.#go();
  }

  say(id, message) {
    this.#messages.push([id, message]);
    this.#go();
  }

  #next() {
    if (this.#ended) return null;
    if (!this.#changes.size && !this.#messages.length) return null;
    const call = ["panels.move", [this.number, [...this.#changes.values()], this.#messages]];
    this.#changes.clear();
    this.#messages = [];
    return call;
  }

  // Nothing is sent any more: the panel is gone, or Python is.
  end() {
    this.#ended = true;
  }

  // What fails keeps nothing else from being sent; it is told at the end, when nothing is said of
  // computing any more.
  async #go() {
    if (this.#going) return;
    this.#going = true;
    this.#busy(true);
    let trouble = null;
    for (let call = this.#next(); call; call = this.#next()) {
      try {
        this.#take(await ask(...call));
      } catch (error) {
        trouble = error;
      }
    }
    this.#going = false;
    this.#busy(false);
    if (trouble) this.onTrouble(trouble);
  }

  #busy(busy) {
    this.onBusy(busy);
    for (const model of this.models.values()) {
      if ("busy" in model.state) model.take("busy", busy);
    }
  }

  #take({ changed, messages, values }) {
    for (const [id, state] of Object.entries(changed)) {
      for (const [name, value] of Object.entries(state)) {
        // What Python computes is said here, by `#busy`; what the reader has moved on stays.
        if (name === "busy" || this.#changes.has(`${id} ${name}`)) continue;
        this.models.get(id)?.take(name, value);
      }
    }
    for (const [id, message] of messages) this.models.get(id)?.hear(message);
    this.onNews({ values });
  }
}
