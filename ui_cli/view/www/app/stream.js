// The connection with the viewer: news as they come, and whether it is there at all.

/** @param on_scene  called with a new scene  @param on_news  called with every other piece  @param on_link  true or false */
export function listen(on_scene, on_news, on_link) {
  const source = new EventSource('api/stream');
  let generation = -1;
  source.onopen = () => { generation = -1; on_link(true); };
  source.onerror = () => on_link(false);
  source.onmessage = (event) => {
    const news = JSON.parse(event.data);
    if (news.scene) { generation = news.generation; on_scene(news.scene); }
    if (news.generation === generation) on_news(news);
  };
}
