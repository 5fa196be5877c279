// Hands a part of the page to the scripts of the workbench; holds no state of its own.
import { mountPane, receiveState } from "ncscope-workbench";

export default {
  template: `<div class="nc-pane"></div>`,
  props: { kind: String, session: String, state: Object },
  mounted() {
    this.pane = mountPane(this.kind, this.$el, this.session);
    if (this.state) receiveState(this.state);
  },
  watch: {
    state: { deep: true, handler(value) { if (value) receiveState(value); } },
  },
  beforeUnmount() {
    this.pane.dispose();
  },
};
