/* The C functions of devices, diagrams and methods, from C: each against a search of every pixel or a
   known value. Also built against an installed copy, through pkg-config. */
#include "test_c_api.h"

static const struct {
  const char* name;
  int exact, continues, windows, volumes, waves;
} some_methods[] = {{"standard-flooding", 0, 0, 0, 0, -1},
                    {"jfa", 0, 0, 0, 1, 6},
                    {"jfa+1", 0, 0, 0, 1, 7},
                    {"jfa+2", 0, 0, 0, 1, 8},
                    {"1+jfa", 0, 0, 0, 1, 7},
                    {"djfa", 0, 1, 0, 0, 6},
                    {"low-resolution", 0, 0, 0, 0, 0},
                    {"exact", 1, 0, 1, 1, 0}};

static void test_devices(const vorocl_device* device) {
  vorocl_device_list* list = NULL;
  vorocl_device_description description;
  vorocl_device *adopted = NULL, *tuned = NULL;
  vorocl_tuning tuning, read;
  const char *name = NULL, *platform = NULL, *driver = NULL;
  cl_context context = NULL;
  cl_command_queue queue = NULL;
  cl_device_id id = NULL, id_of_queue = NULL;
  size_t count = 0, selected = 0;
  OK(vorocl_device_name(device, &name));
  OK(vorocl_device_platform_name(device, &platform));
  OK(vorocl_device_driver_version(device, &driver));

  OK(vorocl_device_list_create(NULL, &list));
  OK(vorocl_device_list_count(list, &count));
  for (size_t i = 0; i < count; ++i) {
    OK(vorocl_device_list_get(list, i, &description));
    CHECK(strlen(description.type) > 0 && strncmp(description.opencl_version, "OpenCL ", 7) == 0);
    CHECK(description.global_memory >= description.max_allocation && description.compute_units > 0);
    if (!description.selected) continue;
    ++selected;
    CHECK(strcmp(description.name, name) == 0 && strcmp(description.platform, platform) == 0);
    CHECK(strcmp(description.driver_version, driver) == 0);
    CHECK(strlen(description.reason) > 0 && strlen(description.why_not) == 0);
  }
  CHECK(selected == 1);
  vorocl_device_list_free(list);
  OK(vorocl_device_list_create("no such device", &list));
  for (size_t i = 0; i < count; ++i) {
    OK(vorocl_device_list_get(list, i, &description));
    CHECK(!description.selected);
  }
  vorocl_device_list_free(list);

  OK(vorocl_device_context(device, &context));
  OK(vorocl_device_queue(device, &queue));
  OK(vorocl_device_id(device, &id));
  CHECK(clGetCommandQueueInfo(queue, CL_QUEUE_DEVICE, sizeof id_of_queue, &id_of_queue, NULL) == CL_SUCCESS);
  CHECK(id == id_of_queue);
  OK(vorocl_device_adopt(context, queue, &adopted));
  OK(vorocl_device_tuning(adopted, &tuning));
  CHECK(tuning.vector_width >= 1 && tuning.group_width * tuning.group_height >= 1);
  tuning.vector_width = tuning.vector_width == 1 ? 2 : 1;
  tuning.group_width = 3;
  tuning.group_height = 2;
  tuning.shape = tuning.shape == VOROCL_GROUP ? VOROCL_VECTOR : VOROCL_GROUP;
  tuning.patch_items = 128;
  OK(vorocl_device_with_tuning(adopted, &tuning, &tuned));
  vorocl_device_free(adopted);
  OK(vorocl_device_tuning(tuned, &read));
  CHECK(read.vector_width == tuning.vector_width && read.group_width == 3 && read.group_height == 2);
  CHECK(read.shape == tuning.shape && read.patch_items == 128);
  vorocl_device_free(tuned);
}

static void test_methods(const vorocl_device* device) {
  vorocl_seeds* seeds = make_seeds(device);
  vorocl_diagram *diagram = NULL, *exact = NULL;
  vorocl_method_options options = VOROCL_METHOD_OPTIONS_DEFAULTS;
  vorocl_method_description method;
  uint32_t nearest[pixels], nearest_manhattan[pixels], by_default[pixels];
  size_t count = 0;
  int waves = -1;
  double percent = 0, milliseconds = -1, host_milliseconds = -1;
  cl_event event = NULL;
  vorocl_metric metric = VOROCL_EUCLIDEAN;
  const char* name = NULL;
  search_all(points, present, seed_count, VOROCL_EUCLIDEAN, nearest);
  search_all(points, present, seed_count, VOROCL_MANHATTAN, nearest_manhattan);
  OK(vorocl_diagram_create(device, window, &diagram));
  OK(vorocl_diagram_create(device, window, &exact));
  OK(vorocl_diagram_event(diagram, &event));
  CHECK(event == NULL);
  OK(vorocl_diagram_method(diagram, &name));
  CHECK(strcmp(name, "") == 0);

  OK(run("exact", seeds, exact, VOROCL_MANHATTAN));
  CHECK(has_labels(exact, nearest_manhattan));
  OK(vorocl_diagram_metric(exact, &metric));
  CHECK(metric == VOROCL_MANHATTAN);
  OK(run("exact", seeds, exact, VOROCL_EUCLIDEAN));
  CHECK(has_labels(exact, nearest));
  OK(vorocl_diagram_metric(exact, &metric));
  CHECK(metric == VOROCL_EUCLIDEAN);

  OK(vorocl_method_count(&count));
  CHECK(count >= sizeof some_methods / sizeof *some_methods);
  count = sizeof some_methods / sizeof *some_methods;
  for (size_t i = 0; i < count; ++i) {
    OK(vorocl_method_get(i, &method));
    CHECK(strcmp(method.name, some_methods[i].name) == 0);
    CHECK(method.exact == some_methods[i].exact && method.continues == some_methods[i].continues);
    CHECK(method.windows == some_methods[i].windows && method.volumes == some_methods[i].volumes);
    OK(vorocl_prepare(method.name, device, window, seed_count, VOROCL_SNAP_NONE, NULL));
    OK(vorocl_run(method.name, seeds, diagram, &options));
    OK(vorocl_diagram_report(diagram, &waves, &milliseconds, &host_milliseconds));
    CHECK(some_methods[i].waves < 0 || waves == some_methods[i].waves);
    CHECK(milliseconds > 0 && host_milliseconds > 0);
    OK(vorocl_diagram_event(diagram, &event));
    CHECK(event != NULL && clWaitForEvents(1, &event) == CL_SUCCESS);
    OK(vorocl_similarity(diagram, exact, &percent));
    CHECK(method.exact ? percent == 100 : percent > 99);
    OK(vorocl_diagram_method(diagram, &name));
    CHECK(strcmp(name, method.name) == 0);

    /* No options are those of the initialiser. */
    OK(vorocl_diagram_read(diagram, by_default, pixels));
    OK(vorocl_run(method.name, seeds, diagram, NULL));
    CHECK(method.continues || has_labels(diagram, by_default));
  }

  /* The options reach the methods. */
  OK(vorocl_run("jfa", seeds, diagram, NULL));
  OK(vorocl_diagram_read(diagram, by_default, pixels));
  options.neighbourhood = VOROCL_MOORE;
  OK(vorocl_run("jfa", seeds, diagram, &options));
  CHECK(has_labels(diagram, by_default));
  options.neighbourhood = VOROCL_VON_NEUMANN;
  OK(vorocl_run("jfa", seeds, diagram, &options));
  CHECK(!has_labels(diagram, by_default)); /* von Neumann waves go wrong, as the paper shows */
  options.metric = VOROCL_MANHATTAN;
  OK(vorocl_run("exact", seeds, diagram, &options));
  CHECK(has_labels(diagram, nearest_manhattan));

  OK(vorocl_device_finish(device));
  vorocl_seeds_free(seeds);
  vorocl_diagram_free(diagram);
  vorocl_diagram_free(exact);
}

/* Four waves go on from labels that are there, six start from seeds alone: 200 seeds are 3.5 pixels apart. */
static void test_dynamic_jump_flooding(const vorocl_device* device) {
  vorocl_seeds* seeds = NULL;
  vorocl_diagram *diagram = NULL, *exact = NULL;
  vorocl_method_options options = VOROCL_METHOD_OPTIONS_DEFAULTS;
  vorocl_point list[200];
  uint32_t nearest[pixels];
  cl_mem labels = NULL;
  cl_event event = NULL;
  int waves = -1;
  size_t changed = 1;
  double percent = 0, milliseconds = -1, host_milliseconds = -1, displacement = -1;
  const char* name = NULL;
  OK(vorocl_seeds_random(device, grid, 200, 7, &seeds));
  OK(vorocl_diagram_create(device, window, &diagram));
  OK(vorocl_diagram_create(device, window, &exact));
  OK(vorocl_run("djfa", seeds, diagram, NULL));
  OK(vorocl_diagram_report(diagram, &waves, NULL, NULL));
  CHECK(waves == 6);
  OK(vorocl_random_step(seeds, 2, VOROCL_PERIODIC, 7, 1));
  options.reach = VOROCL_REACH_PAPER;
  options.max_displacement = 61;
  OK(vorocl_run("djfa", seeds, diagram, &options));
  OK(vorocl_diagram_report(diagram, &waves, NULL, NULL));
  CHECK(waves == 6); /* as far as the grid */
  OK(vorocl_random_step(seeds, 2, VOROCL_REFLECT, 7, 2));
  OK(vorocl_seeds_displacement(seeds, &displacement));
  CHECK(displacement == 2);
  options.max_displacement = VOROCL_DISPLACEMENT_OF_SEEDS;
  OK(vorocl_run("djfa", seeds, diagram, &options)); /* the seeds know */
  OK(vorocl_diagram_report(diagram, &waves, NULL, NULL));
  CHECK(waves == 4);
  OK(run("exact", seeds, exact, VOROCL_EUCLIDEAN));
  OK(vorocl_similarity(diagram, exact, &percent));
  CHECK(percent > 95);

  /* Right labels written into a diagram stay right, and are gone on from with the paper's plan. */
  options.reach = VOROCL_REACH_PAPER;
  options.max_displacement = 0;
  OK(vorocl_seeds_read(seeds, list, 200));
  search_all(list, NULL, 200, VOROCL_EUCLIDEAN, nearest);
  CHECK(has_labels(exact, nearest));
  nearest[5] = VOROCL_NO_LABEL;
  OK(vorocl_diagram_write(diagram, nearest, pixels, NULL, 0));
  OK(vorocl_changed_pixels(diagram, exact, &changed));
  CHECK(changed == 1);
  OK(vorocl_diagram_event(diagram, &event));
  CHECK(event == NULL);
  OK(vorocl_diagram_method(diagram, &name));
  CHECK(strcmp(name, "") == 0);
  OK(vorocl_diagram_report(diagram, &waves, &milliseconds, NULL));
  CHECK(waves == 0 && milliseconds == 0);
  OK(vorocl_run("djfa", seeds, diagram, &options));
  OK(vorocl_diagram_report(diagram, &waves, NULL, NULL));
  CHECK(waves == 4);
  OK(vorocl_changed_pixels(diagram, exact, &changed));
  CHECK(changed == 0);
  OK(vorocl_diagram_labels(exact, &labels));
  options.neighbourhood = VOROCL_VON_NEUMANN;
  OK(vorocl_run("jfa", seeds, diagram, &options));
  options.neighbourhood = VOROCL_DEFAULT_NEIGHBOURHOOD;
  CHECK(!has_labels(diagram, nearest));
  OK(vorocl_diagram_write_buffer(diagram, labels, NULL, 0));
  OK(vorocl_changed_pixels(diagram, exact, &changed));
  CHECK(changed == 0);

  /* The options reach the method. */
  options.extra_waves = 2;
  options.max_displacement = 2;
  OK(vorocl_run("djfa", seeds, diagram, &options));
  OK(vorocl_diagram_report(diagram, &waves, NULL, NULL));
  CHECK(waves == 6);
  options.reach = VOROCL_REACH_AUTHORS;
  OK(vorocl_run("djfa", seeds, diagram, &options));
  OK(vorocl_diagram_report(diagram, &waves, NULL, NULL));
  CHECK(waves == 5);
  options.reach = VOROCL_REACH_PAPER;

  /* A call that fails has no report, and that of an earlier one is gone. */
  options.von_neumann_waves = 3;
  CHECK(vorocl_run("djfa", seeds, diagram, &options) == VOROCL_BAD_ARGUMENT);
  OK(vorocl_diagram_event(diagram, &event));
  CHECK(event == NULL);
  OK(vorocl_diagram_report(diagram, &waves, &milliseconds, &host_milliseconds));
  CHECK(waves == 0 && milliseconds == 0 && host_milliseconds == 0);
  options.von_neumann_waves = 2;
  OK(vorocl_run("djfa", seeds, diagram, &options));
  CHECK(vorocl_run("djfa", NULL, diagram, &options) == VOROCL_NULL_ARGUMENT); /* has done nothing */
  OK(vorocl_diagram_event(diagram, &event));
  CHECK(event != NULL);
  CHECK(vorocl_run("nope", seeds, diagram, &options) == VOROCL_BAD_ARGUMENT);
  OK(vorocl_diagram_event(diagram, &event));
  CHECK(event == NULL);
  OK(vorocl_run("djfa", seeds, diagram, &options));
  CHECK(vorocl_diagram_write(diagram, nearest, pixels - 1, NULL, 0) == VOROCL_BAD_ARGUMENT);
  OK(vorocl_diagram_event(diagram, &event));
  CHECK(event == NULL);

  options.extra_waves = 0;
  options.refresh_interval = 1;
  OK(vorocl_run("djfa", seeds, diagram, &options));
  OK(vorocl_diagram_report(diagram, &waves, NULL, NULL));
  CHECK(waves == 6);
  vorocl_seeds_free(seeds);
  vorocl_diagram_free(diagram);
  vorocl_diagram_free(exact);
}

/* What was made on a device outlives it, and a diagram the seeds it was made from. */
static void test_order_of_freeing(void) {
  vorocl_device* device = NULL;
  vorocl_seeds* seeds = NULL;
  vorocl_diagram* diagram = NULL;
  vorocl_cell_sums* sums = NULL;
  uint32_t nearest[pixels], area[seed_count], all = 0;
  search_all(points, present, seed_count, VOROCL_EUCLIDEAN, nearest);
  OK(vorocl_device_select("", &device));
  seeds = make_seeds(device);
  OK(vorocl_diagram_create(device, window, &diagram));
  vorocl_device_free(device);
  OK(run("exact", seeds, diagram, VOROCL_EUCLIDEAN));
  vorocl_seeds_free(seeds);
  CHECK(has_labels(diagram, nearest));
  OK(vorocl_cell_sums_create(&sums));
  OK(vorocl_cell_sums_measure(sums, diagram)); /* of seeds that it remembers */
  vorocl_diagram_free(diagram);
  OK(vorocl_cell_sums_read(sums, area, NULL, NULL, NULL, seed_count));
  for (int id = 0; id < seed_count; ++id) all += area[id];
  CHECK(all == pixels);
  vorocl_cell_sums_free(sums);
}

int main(void) {
  vorocl_device* device = NULL;
  CHECK(strlen(vorocl_version()) >= 5);
  CHECK(strcmp(vorocl_error_message(), "") == 0); /* nothing has failed yet */
  OK(vorocl_device_select(NULL, &device));
  if (device == NULL) return EXIT_FAILURE;
  test_devices(device);
  test_methods(device);
  test_dynamic_jump_flooding(device);
  test_order_of_freeing();
  vorocl_device_free(device);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
